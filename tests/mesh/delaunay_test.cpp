#include "core/mesh/delaunay.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/mesh/random.h"

namespace dmoscope {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;

/// In-circle determinant in long double, which is exact for the small coordinates used here (products below 2^63).
long double in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto row = [d](GridPoint p) {
    const long double x = p.x - d.x;
    const long double y = p.y - d.y;
    return std::array<long double, 3>{x, y, x * x + y * y};
  };
  const auto p = row(a);
  const auto q = row(b);
  const auto r = row(c);
  return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

long twice_area(GridPoint a, GridPoint b, GridPoint c) {
  return static_cast<long>(b.x - a.x) * (c.y - a.y) - static_cast<long>(b.y - a.y) * (c.x - a.x);
}

void expect_delaunay(const std::vector<GridPoint>& points, long twice_hull_area) {
  Progress progress;
  const Triangles triangles = delaunay(points, progress);
  long total = 0;
  std::set<Index> used;
  for (const auto& [a, b, c] : triangles) {
    const long area = twice_area(points[a], points[b], points[c]);
    EXPECT_GT(area, 0);
    total += area;
    used.insert({a, b, c});
    for (const GridPoint& d : points) EXPECT_LE(in_circle(points[a], points[b], points[c], d), 0.0L);
  }
  EXPECT_EQ(total, twice_hull_area);
  EXPECT_EQ(used.size(), points.size());
}

TEST(Delaunay, EmptyCirclesOnRandomPoints) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    std::vector<GridPoint> points{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
    while (points.size() < 150) {
      const GridPoint p{static_cast<std::int32_t>(random.below(1001)), static_cast<std::int32_t>(random.below(1001))};
      if (std::ranges::find(points, p) == points.end()) points.push_back(p);
    }
    expect_delaunay(points, 2000000);
  }
}

TEST(Delaunay, CocircularAndCollinearPoints) {
  std::vector<GridPoint> points;
  for (std::int32_t j = 0; j < 9; ++j) {
    for (std::int32_t i = 0; i < 12; ++i) points.push_back({i * 10 - 50, j * 10 - 70});
  }
  expect_delaunay(points, 2 * 110 * 80);
}

TEST(Delaunay, PointsOnOneLineGiveNothingAndTwinsAreUsedOnce) {
  Progress progress;
  EXPECT_TRUE(delaunay(std::vector<GridPoint>{{0, 0}, {1, 1}, {2, 2}, {5, 5}}, progress).empty());
  EXPECT_TRUE(delaunay(std::vector<GridPoint>{}, progress).empty());
  EXPECT_EQ(delaunay(std::vector<GridPoint>{{0, 0}, {4, 0}, {4, 0}, {0, 4}, {0, 0}, {0, 4}}, progress).size(), 1U);
}

TEST(Delaunay, LargestCoordinatesDoNotOverflow) {
  constexpr std::int32_t m = 1 << 28;
  Progress progress;
  const std::vector<GridPoint> points{{-m, -m}, {m, -m}, {m, m}, {-m, m}, {0, 1}};
  EXPECT_EQ(delaunay(points, progress).size(), 4U);
}

TEST(Delaunay, CanBeCancelled) {
  Progress progress;
  progress.request_cancel();
  std::vector<GridPoint> points;
  for (std::int32_t i = 0; i < 10000; ++i) points.push_back({i, i * i % 7919});
  EXPECT_THROW((void)delaunay(points, progress), Cancelled);
}

}  // namespace
}  // namespace dmoscope
