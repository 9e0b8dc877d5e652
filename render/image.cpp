#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

/// sRGB's transfer function, 8 bits to linear light.
const std::array<float, 256>& linear_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      values[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

std::uint8_t to_srgb(float linear) {
  // The nearest entry of the table: exact for colours that were 8-bit sRGB before.
  const auto& table = linear_table();
  const auto above = std::lower_bound(table.begin(), table.end(), linear);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const auto below = above - 1;
  return static_cast<std::uint8_t>((linear - *below < *above - linear ? below : above) - table.begin());
}

std::size_t offset(const Image& image, int x, int y) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

/// A channel as it looks on middle grey.
double on_grey(const std::uint8_t* pixel, std::size_t channel) {
  return 128.0 + (static_cast<double>(pixel[channel]) - 128.0) * static_cast<double>(pixel[3]) / 255.0;
}

double luminance(const std::uint8_t* pixel) { return 0.299 * on_grey(pixel, 0) + 0.587 * on_grey(pixel, 1) + 0.114 * on_grey(pixel, 2); }

/// Structural similarity (Wang et al. 2004) of one window, with that paper's constants for 8 bits.
double window_ssim(const Image& a, const Image& b, int left, int top, int right, int bottom) {
  double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double va = luminance(a.rgba.data() + offset(a, x, y)), vb = luminance(b.rgba.data() + offset(b, x, y));
      sum_a += va;
      sum_b += vb;
      sum_aa += va * va;
      sum_bb += vb * vb;
      sum_ab += va * vb;
    }
  }
  const double n = static_cast<double>((right - left) * (bottom - top));
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = sum_aa / n - mean_a * mean_a, var_b = sum_bb / n - mean_b * mean_b, cov = sum_ab / n - mean_a * mean_b;
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  return (2 * mean_a * mean_b + kC1) * (2 * cov + kC2) / ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

}  // namespace

Image::Image(int w, int h, Rgba fill)
    : width(w), height(h), rgba(std::size_t{4} * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    rgba[i] = fill.r;
    rgba[i + 1] = fill.g;
    rgba[i + 2] = fill.b;
    rgba[i + 3] = fill.a;
  }
}

Rgba Image::at(int x, int y) const {
  const std::uint8_t* p = rgba.data() + offset(*this, x, y);
  return {p[0], p[1], p[2], p[3]};
}

void Image::set(int x, int y, Rgba colour) {
  std::uint8_t* p = rgba.data() + offset(*this, x, y);
  p[0] = colour.r;
  p[1] = colour.g;
  p[2] = colour.b;
  p[3] = colour.a;
}

Image downsample(const Image& image, int n) {
  if (n < 1 || image.width % n != 0 || image.height % n != 0) throw UsageError("a picture can only be divided into whole blocks");
  if (n == 1) return image;
  const auto& linear = linear_table();
  Image result(image.width / n, image.height / n);
  const float samples = static_cast<float>(n * n);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      float sum[3] = {0, 0, 0}, alpha = 0;
      for (int j = 0; j < n; ++j) {
        const std::uint8_t* p = image.rgba.data() + offset(image, x * n, y * n + j);
        for (int i = 0; i < n; ++i, p += 4) {
          const float a = static_cast<float>(p[3]) / 255.0F;
          alpha += a;
          for (int c = 0; c < 3; ++c) sum[c] += a * linear[p[c]];
        }
      }
      if (alpha <= 0.0F) continue;
      result.set(x, y,
                 {to_srgb(sum[0] / alpha), to_srgb(sum[1] / alpha), to_srgb(sum[2] / alpha),
                  static_cast<std::uint8_t>(std::lround(255.0F * alpha / samples))});
    }
  }
  return result;
}

void blend_over(Image& bottom, const Image& top, int x, int y) {
  for (int j = std::max(0, -y); j < top.height && y + j < bottom.height; ++j) {
    for (int i = std::max(0, -x); i < top.width && x + i < bottom.width; ++i) {
      const Rgba over = top.at(i, j), under = bottom.at(x + i, y + j);
      const float a = static_cast<float>(over.a) / 255.0F, b = static_cast<float>(under.a) / 255.0F * (1.0F - a), sum = a + b;
      if (sum <= 0.0F) continue;
      const auto mix = [&](std::uint8_t o, std::uint8_t u) {
        return static_cast<std::uint8_t>(std::lround((static_cast<float>(o) * a + static_cast<float>(u) * b) / sum));
      };
      bottom.set(x + i, y + j,
                 {mix(over.r, under.r), mix(over.g, under.g), mix(over.b, under.b), static_cast<std::uint8_t>(std::lround(255.0F * sum))});
    }
  }
}

Difference compare(const Image& a, const Image& b) {
  Difference difference;
  if (a.width != b.width || a.height != b.height || a.rgba.empty()) return difference;
  difference.same_size = true;
  difference.largest = 0;
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int worst = std::abs(int{a.rgba[i + 3]} - int{b.rgba[i + 3]});
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, static_cast<int>(std::lround(std::abs(on_grey(&a.rgba[i], c) - on_grey(&b.rgba[i], c)))));
    }
    difference.largest = std::max(difference.largest, worst);
    if (worst > 16) ++off;
  }
  difference.off_share = static_cast<double>(off) / (static_cast<double>(a.rgba.size()) / 4.0);
  double sum = 0.0;
  std::size_t windows = 0;
  for (int top = 0; top < a.height; top += 8) {
    for (int left = 0; left < a.width; left += 8, ++windows) {
      sum += window_ssim(a, b, left, top, std::min(left + 8, a.width), std::min(top + 8, a.height));
    }
  }
  difference.ssim = sum / static_cast<double>(windows);
  return difference;
}

}  // namespace dmoscope::render
