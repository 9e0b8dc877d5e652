#pragma once
// Comparison of two pictures.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "render/image.h"

namespace dmoscope::render {

/// Measures of the difference of two pictures.
struct Difference {
  bool same_size = false;
  double off_share = 1.0;  // share of pixels with a channel that differs by more than 16
  int largest = 255;       // largest difference of a channel
  double ssim = 0.0;       // mean structural similarity of the luminance over 8 x 8 windows, 1: the same
  /// Whether the pictures are alike: same size, and less than `share` of the pixels off.
  [[nodiscard]] bool alike(double share = 0.005) const noexcept { return same_size && off_share < share; }
};
inline std::size_t pixel_offset(const Image& image, int x, int y) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

/// Value of a channel in front of middle grey.
inline double on_grey(const std::uint8_t* pixel, std::size_t channel) {
  return 128.0 + (static_cast<double>(pixel[channel]) - 128.0) * static_cast<double>(pixel[3]) / 255.0;
}

inline double luminance(const std::uint8_t* pixel) {
  return 0.299 * on_grey(pixel, 0) + 0.587 * on_grey(pixel, 1) + 0.114 * on_grey(pixel, 2);
}

/// Structural similarity (Wang et al. 2004) of one window, with that paper's constants for 8 bits.
inline double window_ssim(const Image& a, const Image& b, int left, int top, int right, int bottom) {
  double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double va = luminance(a.rgba.data() + pixel_offset(a, x, y)), vb = luminance(b.rgba.data() + pixel_offset(b, x, y));
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

/// Compares two pictures as if each lay on middle grey. Pictures of different sizes are always different.
inline Difference compare(const Image& a, const Image& b) {
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
