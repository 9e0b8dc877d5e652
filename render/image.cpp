#include "render/image.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

/// Table of sRGB's transfer function, from 8 bits to linear light.
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

}  // namespace dmoscope::render
