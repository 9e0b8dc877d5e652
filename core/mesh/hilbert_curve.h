#pragma once
// Places of points along a Hilbert curve: pieces of it are compact in space, so it cuts a mesh into parts with little between them.

#include <cstdint>

#include "core/base/vec.h"

namespace dmoscope {

/// The curve over a box of the plane (low.z == high.z, or any other direction without extent) or of space.
class HilbertCurve {
 public:
  HilbertCurve(Vec3 low, Vec3 high);
  /// Place of a point along the curve, ascending; a point outside of the box counts as one on its side.
  [[nodiscard]] std::uint64_t key(Vec3 point) const;

 private:
  Vec3 low_;
  double scale_ = 0.0;  // scale from mesh units to cells of the finest grid
  int axes_[3] = {0, 1, 2};
  int dimension_ = 3;  // number of axes with an extent
};

/// Spreads the 32 bits of `x` over every second bit of the result.
[[nodiscard]] std::uint64_t spread_by_two(std::uint64_t x) noexcept;
/// Spreads the lowest 21 bits of `x` over every third bit of the result.
[[nodiscard]] std::uint64_t spread_by_three(std::uint64_t x) noexcept;

}  // namespace dmoscope
