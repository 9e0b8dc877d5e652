#pragma once
// Where points lie along a Hilbert curve: pieces of it are compact in space, so it cuts a mesh into parts with little between them.

#include <cstdint>

#include "core/base/vec.h"

namespace dmoscope {

/// The curve over a box of the plane (low.z == high.z, or any other direction without extent) or of space.
class HilbertCurve {
 public:
  HilbertCurve(Vec3 low, Vec3 high);
  /// Ascending along the curve; of points outside the box that of a point on its side.
  [[nodiscard]] std::uint64_t key(Vec3 point) const;

 private:
  Vec3 low_;
  double scale_ = 0.0;  // to cells of the finest grid
  int axes_[3] = {0, 1, 2};
  int dimension_ = 3;  // axes with an extent
};

/// Every second bit of the result is one of the 32 of `x`.
[[nodiscard]] std::uint64_t spread_by_two(std::uint64_t x) noexcept;
/// Every third bit of the result is one of the 21 of `x`.
[[nodiscard]] std::uint64_t spread_by_three(std::uint64_t x) noexcept;

}  // namespace dmoscope
