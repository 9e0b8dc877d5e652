#include "core/mesh/hilbert_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope {
namespace {

/// Bits of each coordinate, by dimension: together they fit in 64.
constexpr std::array<int, 4> kBits{0, 32, 31, 21};

double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Turns a cell's coordinates into the digits of its place on the curve, one bit of each digit in each coordinate.
/// J. Skilling, Programming the Hilbert curve, AIP Conference Proceedings 707 (2004).
void to_curve(std::array<std::uint32_t, 3>& x, int bits, int n) {
  const auto at = [&x](int i) -> std::uint32_t& { return x[static_cast<std::size_t>(i)]; };
  for (std::uint32_t q = 1U << static_cast<unsigned>(bits - 1); q > 1; q >>= 1U) {
    const std::uint32_t low = q - 1;
    for (int i = 0; i < n; ++i) {
      if ((at(i) & q) != 0) {
        at(0) ^= low;
      } else {
        const std::uint32_t swapped = (at(0) ^ at(i)) & low;
        at(0) ^= swapped;
        at(i) ^= swapped;
      }
    }
  }
  for (int i = 1; i < n; ++i) at(i) ^= at(i - 1);  // Gray code
  std::uint32_t turned = 0;
  for (std::uint32_t q = 1U << static_cast<unsigned>(bits - 1); q > 1; q >>= 1U)
    if ((at(n - 1) & q) != 0) turned ^= q - 1;
  for (int i = 0; i < n; ++i) at(i) ^= turned;
}

}  // namespace

std::uint64_t spread_by_two(std::uint64_t x) noexcept {
  x = (x | x << 16U) & 0x0000ffff0000ffffU;
  x = (x | x << 8U) & 0x00ff00ff00ff00ffU;
  x = (x | x << 4U) & 0x0f0f0f0f0f0f0f0fU;
  x = (x | x << 2U) & 0x3333333333333333U;
  return (x | x << 1U) & 0x5555555555555555U;
}

std::uint64_t spread_by_three(std::uint64_t x) noexcept {
  x = (x | x << 32U) & 0x001f00000000ffffU;
  x = (x | x << 16U) & 0x001f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

HilbertCurve::HilbertCurve(Vec3 low, Vec3 high) : low_(low) {
  const Vec3 size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  dimension_ = 0;
  for (const int axis : {0, 1, 2})
    if (coordinate(size, axis) > 1e-9 * longest) axes_[dimension_++] = axis;
  if (dimension_ == 0 || !std::isfinite(longest)) {
    dimension_ = 0;
    return;
  }
  const int bits = kBits[static_cast<std::size_t>(dimension_)];
  scale_ = (std::ldexp(1.0, bits) - 1.0) / longest;
}

std::uint64_t HilbertCurve::key(Vec3 point) const {
  if (dimension_ == 0) return 0;
  const int bits = kBits[static_cast<std::size_t>(dimension_)];
  const double most = std::ldexp(1.0, bits) - 1.0;
  std::array<std::uint32_t, 3> x{};
  for (int i = 0; i < dimension_; ++i) {
    const double cell = (coordinate(point, axes_[i]) - coordinate(low_, axes_[i])) * scale_;
    x[static_cast<std::size_t>(i)] = cell > 0.0 ? static_cast<std::uint32_t>(std::min(cell, most)) : 0U;
  }
  if (dimension_ == 1) return x[0];
  to_curve(x, bits, dimension_);
  if (dimension_ == 2) return spread_by_two(x[0]) << 1U | spread_by_two(x[1]);
  return spread_by_three(x[0]) << 2U | spread_by_three(x[1]) << 1U | spread_by_three(x[2]);
}

}  // namespace dmoscope
