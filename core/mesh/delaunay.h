#pragma once
// Delaunay triangulation of points on an integer grid, exact: no rounding, no tolerance, the same on every machine.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/vec.h"

namespace dmoscope {

/// A point of the integer grid; |x| and |y| at most 2^28, so that the in-circle determinant fits 128 bits.
struct GridPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(GridPoint, GridPoint) = default;
};

/// Delaunay triangles (counter-clockwise) of distinct points; together they fill the convex hull. Empty when all points lie on one line.
/// Incremental insertion with flips (Lawson 1977) in a biased randomised order (Amenta, Choi, Rote 2003); about n log n.
/// Points given twice are used once. Throws Cancelled; sets progress from 0 to 1.
[[nodiscard]] std::vector<std::array<Index, 3>> delaunay(std::span<const GridPoint> points, Progress& progress);

}  // namespace dmoscope
