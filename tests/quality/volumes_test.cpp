// The metrics of volume elements against elementary geometry in long double, and properties of all of them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/mesh/random.h"
#include "core/quality/formulas.h"

namespace dmoscope {
namespace {

using formulas::Hexahedron;
using formulas::Pyramid;
using formulas::Tetrahedron;
using formulas::Wedge;

const Tetrahedron<Vec3> kRegular({1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1});
const Hexahedron<Vec3> kCube{{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
const Wedge<Vec3> kPrism{{Vec3{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0, 0, 1}, {1, 0, 1}, {0.5, std::sqrt(0.75), 1}}};
const Pyramid<Vec3> kPyramid{{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}}};

constexpr Metric kOfCorners[] = {Metric::MeanRatio, Metric::ScaledJacobian, Metric::Condition};
constexpr Metric kOfTetrahedra[] = {Metric::MeanRatio,      Metric::RadiusRatio, Metric::MinAngle,
                                    Metric::ScaledJacobian, Metric::AspectRatio, Metric::Condition};

double value(Metric metric, const Tetrahedron<Vec3>& t) {
  return formulas::with_volume_metric(metric, [&]<Metric M>() { return formulas::metric<M>(t); });
}
template <class Element>
double corner_value(Metric metric, const Element& s) {
  return formulas::with_volume_metric(metric, [&]<Metric M>() {
    if constexpr (formulas::kDefinedForCorners<M>)
      return formulas::metric<M>(s);
    else
      return std::nan("");
  });
}

TEST(VolumeElements, IdealElementsAreWorthOne) {
  for (const Metric metric : kOfTetrahedra) EXPECT_NEAR(value(metric, kRegular), 1.0, 1e-14) << info(metric).name;
  for (const Metric metric : kOfCorners) {
    EXPECT_NEAR(corner_value(metric, kCube), 1.0, 1e-14) << info(metric).name;
    EXPECT_NEAR(corner_value(metric, kPrism), 1.0, 1e-14) << info(metric).name;
    EXPECT_NEAR(corner_value(metric, kPyramid), 1.0, 1e-14) << info(metric).name;
  }
}

Vec3 random_point(Random& random) { return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}; }

TEST(VolumeElements, ATetrahedronIsAsGoodFromEveryCornerAndAsBadInsideOut) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random), d = random_point(random);
    for (const Metric metric : kOfTetrahedra) {
      const double q = value(metric, {a, b, c, d});
      EXPECT_NEAR(value(metric, {b, a, d, c}), q, 1e-11) << info(metric).name;
      EXPECT_NEAR(value(metric, {c, a, b, d}), q, 1e-11) << info(metric).name;
      EXPECT_NEAR(value(metric, {b, a, c, d}), -q, 1e-11) << info(metric).name;
      EXPECT_LE(std::abs(q), 1.0 + 1e-12) << info(metric).name;
      EXPECT_EQ(q > 0.0, Tetrahedron<Vec3>(a, b, c, d).six_volume > 0.0) << info(metric).name;
    }
  }
}

TEST(VolumeElements, ScaledAndTurnedAnElementIsWorthTheSame) {
  const auto moved = [](Vec3 p, double scale) {  // turned by a rotation with rational entries
    return scale * Vec3{(2 * p.x - 2 * p.y + p.z) / 3, (2 * p.x + p.y - 2 * p.z) / 3, (p.x + 2 * p.y + 2 * p.z) / 3};
  };
  Random random(8);
  for (const double scale : {1e-5, 1.0, 1e4}) {
    for (int trial = 0; trial < 50; ++trial) {
      Hexahedron<Vec3> h = kCube, other;
      for (std::size_t i = 0; i < 8; ++i) {
        h.at[i] = h.at[i] + 0.4 * random_point(random);
        other.at[i] = moved(h.at[i], scale);
      }
      for (const Metric metric : kOfCorners)
        EXPECT_NEAR(corner_value(metric, h), corner_value(metric, other), 1e-12) << info(metric).name << ' ' << scale;
    }
  }
}

/// Insphere and circumsphere by the faces' areas and the Cayley-Menger determinant in long double.
TEST(VolumeElements, RadiiOfATetrahedronByOtherWays) {
  using Wide = long double;
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p[4] = {random_point(random), random_point(random), random_point(random), random_point(random)};
    const auto edge = [&](int i, int k) {
      return std::hypot(static_cast<Wide>(p[i].x) - p[k].x, static_cast<Wide>(p[i].y) - p[k].y, static_cast<Wide>(p[i].z) - p[k].z);
    };
    const auto area = [&](int i, int j, int k) {  // Heron
      const Wide a = edge(i, j), b = edge(j, k), c = edge(k, i), s = (a + b + c) / 2;
      return std::sqrt(std::max<Wide>(0, s * (s - a) * (s - b) * (s - c)));
    };
    const Wide surface = area(0, 1, 2) + area(0, 1, 3) + area(0, 2, 3) + area(1, 2, 3);
    const Tetrahedron<Vec3> t(p[0], p[1], p[2], p[3]);
    const Wide volume = std::abs(static_cast<Wide>(t.six_volume)) / 6;
    if (volume < 1e-2L) continue;
    const Wide inradius = 3 * volume / surface;
    const Wide x = edge(0, 1) * edge(2, 3), y = edge(0, 2) * edge(1, 3), z = edge(0, 3) * edge(1, 2), s = (x + y + z) / 2;
    const Wide circumradius = std::sqrt(s * (s - x) * (s - y) * (s - z)) / (6 * volume);
    Wide longest = 0;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < i; ++k) longest = std::max(longest, edge(i, k));
    const double sign = t.six_volume > 0 ? 1.0 : -1.0;
    EXPECT_NEAR(value(Metric::RadiusRatio, t), sign * static_cast<double>(3 * inradius / circumradius), 1e-10);
    EXPECT_NEAR(value(Metric::AspectRatio, t), sign * static_cast<double>(2 * std::sqrt(6.0L) * inradius / longest), 1e-10);
  }
}

TEST(VolumeElements, OneTurnedCornerMakesAnElementNegative) {
  Hexahedron<Vec3> h = kCube;
  h.at[6] = {0.2, 0.2, 0.2};  // beyond the plane of its neighbours
  for (const Metric metric : kOfCorners) EXPECT_LT(corner_value(metric, h), 0.0) << info(metric).name;
  EXPECT_LT(formulas::smallest_jacobian(h), 0.0);
  EXPECT_LT(formulas::smallest_jacobian_around(h, 6), 0.0);
  EXPECT_GT(formulas::smallest_jacobian_around(h, 0), 0.0) << "corner 0 has no edge to corner 6";
}

TEST(VolumeElements, DegenerateOnesAreWorthNothing) {
  const Tetrahedron<Vec3> point({}, {}, {}, {}), flat({}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0});
  for (const Metric metric : kOfTetrahedra) {
    EXPECT_EQ(value(metric, point), 0.0) << info(metric).name;
    EXPECT_EQ(value(metric, flat), 0.0) << info(metric).name;
  }
}

/// Ranks of the fast search are an increasing function of the metric, and 0 for 0.
TEST(VolumeElements, RanksRiseWithTheMetric) {
  Random random(10);
  for (const Metric metric : kOfTetrahedra) {
    std::vector<std::pair<double, double>> all;
    for (int trial = 0; trial < 300; ++trial) {
      const Tetrahedron<Vec3> t(random_point(random), random_point(random), random_point(random), random_point(random));
      all.emplace_back(value(metric, t), formulas::with_volume_metric(metric, [&]<Metric M>() { return formulas::rank<M>(t); }));
    }
    std::ranges::sort(all);
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_GE(all[i].second, all[i - 1].second - 1e-9) << info(metric).name;
      EXPECT_EQ(all[i].first > 0, all[i].second > 0) << info(metric).name;
    }
  }
  std::vector<std::pair<double, double>> all;
  for (int trial = 0; trial < 300; ++trial) {
    Wedge<Vec3> w = kPrism;
    for (Vec3& p : w.at) p = p + 0.5 * random_point(random);
    all.emplace_back(formulas::metric_around<Metric::MeanRatio>(w, 0), formulas::rank_around<Metric::MeanRatio>(w, 0));
  }
  for (const auto& [q, rank] : all) EXPECT_NEAR(rank, q * q * q, 1e-12);
}

TEST(CubeRoot, IsTheLibrarysToAFewUnitsInTheLastPlace) {
  Random random(11);
  for (int trial = 0; trial < 100000; ++trial) {
    const double x = std::ldexp(random.between(-1, 1), static_cast<int>(random.below(1900)) - 950);
    EXPECT_NEAR(scalar::cube_root(x), std::cbrt(x), 7e-16 * std::abs(std::cbrt(x)));
  }
  EXPECT_EQ(scalar::cube_root(0.0), 0.0);
  EXPECT_EQ(scalar::cube_root(-8.0), -2.0);
}

}  // namespace
}  // namespace dmoscope
