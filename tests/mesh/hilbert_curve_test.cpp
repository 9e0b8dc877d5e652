// Places along a Hilbert curve: neighbours along it are neighbours in space.

#include "core/mesh/hilbert_curve.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace dmoscope {
namespace {

/// Expects every step between consecutive points of the curve to be an edge of the lattice.
void expect_unit_steps(int side, int dimension) {
  std::vector<Vec3> points;
  for (int k = 0; k < (dimension == 3 ? side : 1); ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) points.push_back({i + 0.5, j + 0.5, dimension == 3 ? k + 0.5 : 0.0});
  const HilbertCurve curve({0, 0, 0}, {1.0 * side, 1.0 * side, dimension == 3 ? 1.0 * side : 0.0});
  std::ranges::sort(points, {}, [&](Vec3 p) { return curve.key(p); });
  std::set<std::uint64_t> keys;
  for (const Vec3& p : points) keys.insert(curve.key(p));
  EXPECT_EQ(keys.size(), points.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 step = points[i] - points[i - 1];
    EXPECT_DOUBLE_EQ(std::abs(step.x) + std::abs(step.y) + std::abs(step.z), 1.0) << "step " << i;
  }
}

TEST(HilbertCurve, GoesFromCellToNeighbour) {
  for (const int side : {2, 8, 32}) expect_unit_steps(side, 2);
  for (const int side : {2, 8, 16}) expect_unit_steps(side, 3);
}

TEST(HilbertCurve, TakesAnyBox) {
  EXPECT_EQ(HilbertCurve({1, 2, 3}, {1, 2, 3}).key({1, 2, 3}), 0U);
  const HilbertCurve line({0, 5, 0}, {0, 9, 0});
  EXPECT_LT(line.key({0, 5.5, 0}), line.key({0, 8, 0}));
  const HilbertCurve plane({0, 0, 7}, {4, 4, 7});
  EXPECT_EQ(plane.key({-3, -3, 7}), plane.key({0, 0, 7}));
  EXPECT_EQ(plane.key({9, 9, 7}), plane.key({4, 4, 7}));
}

}  // namespace
}  // namespace dmoscope
