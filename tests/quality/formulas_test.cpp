// The metrics against values computed in other ways: elementary geometry in long double.

#include "core/quality/formulas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using V = Vec2<double>;
using Corners = std::array<V, 4>;

double triangle_quality(Metric metric, V a, V b, V c) {
  return formulas::with_planar_metric(metric, [&]<Metric M>() { return formulas::Formula<M>::triangle(formulas::Triangle<V>(a, b, c)); });
}
double quadrilateral_quality(Metric metric, const Corners& p) {
  const formulas::Quadrilateral<V> q(p[0], p[1], p[2], p[3]);
  return formulas::with_planar_metric(metric, [&]<Metric M>() {
    if constexpr (formulas::kDefinedForQuadrilaterals<M, V>)
      return formulas::Formula<M>::quadrilateral(q);
    else
      return std::nan("");
  });
}

/// Sides, angles, area, radii of a triangle by the law of cosines and Heron, in long double.
struct Measured {
  long double side[3], angle[3], area, inradius, circumradius;
  Measured(V a, V b, V c) {
    const V p[3] = {a, b, c};
    for (int i = 0; i < 3; ++i)
      side[i] = std::hypot(static_cast<long double>(p[(i + 1) % 3].x) - p[i].x, static_cast<long double>(p[(i + 1) % 3].y) - p[i].y);
    const long double s = (side[0] + side[1] + side[2]) / 2;
    area = std::sqrt(s * (s - side[0]) * (s - side[1]) * (s - side[2]));
    for (int i = 0; i < 3; ++i) {  // angle at corner i lies between sides i and i + 2, opposite side i + 1
      const long double u = side[i], v = side[(i + 2) % 3], w = side[(i + 1) % 3];
      angle[i] = std::acos((u * u + v * v - w * w) / (2 * u * v));
    }
    inradius = area / s;
    circumradius = side[0] * side[1] * side[2] / (4 * area);
  }
};

long double expected(Metric metric, const Measured& m) {
  const long double pi = std::numbers::pi_v<long double>;
  const auto [least, most] = std::minmax({m.angle[0], m.angle[1], m.angle[2]});
  const long double longest = std::max({m.side[0], m.side[1], m.side[2]});
  const long double perimeter = m.side[0] + m.side[1] + m.side[2];
  switch (metric) {
    case Metric::Condition:  // not defined for triangles
      return 0;
    case Metric::MeanRatio:
    case Metric::MeanRatioArea:
      return 4 * std::sqrt(3.0L) * m.area / (m.side[0] * m.side[0] + m.side[1] * m.side[1] + m.side[2] * m.side[2]);
    case Metric::RadiusRatio:
      return 2 * m.inradius / m.circumradius;
    case Metric::MinAngle:
      return 3 * least / pi;
    case Metric::MaxAngle:
      return 1.5L * (1 - most / pi);
    case Metric::Rectangularity: {
      long double best = 0;
      for (int i = 0; i < 3; ++i) {
        const long double u = m.side[i], v = m.side[(i + 2) % 3];
        best = std::max(best, (1 - std::fabs(pi / 2 - m.angle[i]) / (pi / 2)) * (1 - std::fabs(u - v) / std::max(u, v)));
      }
      return best;
    }
    case Metric::ScaledJacobian:
      return 2 / std::sqrt(3.0L) * std::sin(least);
    case Metric::AspectRatio:
      return 4 * std::sqrt(3.0L) * m.area / (longest * perimeter);
  }
  return 0;
}

TEST(Formulas, RandomTrianglesAgreeWithElementaryGeometry) {
  testing::Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    V p[3];
    for (V& q : p) q = {random(-1, 1), random(-1, 1)};
    double area2 = cross(p[1] - p[0], p[2] - p[0]);
    if (std::fabs(area2) < 0.01) continue;  // the reference itself loses digits there
    const double sign = area2 > 0 ? 1.0 : -1.0;
    for (const MetricInfo& entry : metric_table()) {
      if (!entry.defined_for(ElementKind::Triangle)) continue;
      const double reference = static_cast<double>(expected(entry.metric, Measured(p[0], p[1], p[2])));
      EXPECT_NEAR(triangle_quality(entry.metric, p[0], p[1], p[2]), sign * reference, 1e-12) << entry.name;
    }
  }
}

TEST(Formulas, IdealElementsHaveQualityOne) {
  const V a{0, 0}, b{1, 0}, c{0.5, std::sqrt(3.0) / 2};
  for (const MetricInfo& entry : metric_table()) {
    if (entry.metric == Metric::Rectangularity)
      EXPECT_NEAR(triangle_quality(entry.metric, a, b, {0, 1}), 1.0, 1e-15) << "its ideal is the right isosceles triangle";
    else
      EXPECT_NEAR(triangle_quality(entry.metric, a, b, c), 1.0, 1e-15) << entry.name;
    if (entry.defined_for(ElementKind::Quadrilateral)) {
      EXPECT_NEAR(quadrilateral_quality(entry.metric, {V{0, 0}, V{1, 0}, V{1, 1}, V{0, 1}}), 1.0, 1e-15) << entry.name;
    }
  }
}

TEST(Formulas, DegenerateElementsAreNeverPositiveNorNaN) {
  const V o{0, 0}, x{1, 0}, far{3, 0};
  for (const MetricInfo& entry : metric_table()) {
    for (const auto& [a, b, c] : {std::array{o, o, o}, std::array{o, o, x}, std::array{o, x, far}, std::array{o, far, x}})
      EXPECT_LE(triangle_quality(entry.metric, a, b, c), 0.0) << entry.name;
    if (entry.defined_for(ElementKind::Quadrilateral)) {
      EXPECT_LE(quadrilateral_quality(entry.metric, {o, o, o, o}), 0.0) << entry.name;
      EXPECT_LE(quadrilateral_quality(entry.metric, {o, x, far, x}), 0.0) << entry.name;
    }
  }
}

TEST(Formulas, QuadrilateralsByHand) {
  const Corners rectangle{V{0, 0}, V{2, 0}, V{2, 1}, V{0, 1}};
  EXPECT_NEAR(quadrilateral_quality(Metric::MeanRatio, rectangle), 2 * 2.0 / 5, 1e-15);
  EXPECT_NEAR(quadrilateral_quality(Metric::MeanRatioArea, rectangle), 8.0 / 10, 1e-15);
  EXPECT_NEAR(quadrilateral_quality(Metric::ScaledJacobian, rectangle), 1.0, 1e-15);
  const Corners arrow{V{0, 0}, V{1, 0}, V{0.4, 0.4}, V{0, 1}};  // concave at its third corner
  EXPECT_NEAR(quadrilateral_quality(Metric::MeanRatio, arrow), -2 * 0.2 / (0.52 + 0.52), 1e-15);
  EXPECT_GT(quadrilateral_quality(Metric::MeanRatioArea, arrow), 0.0) << "by its very definition it cannot see this";
}

TEST(Formulas, AnyCornerMayComeFirstAndAnySimilarityMapLeavesQualityAlone) {
  testing::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    Corners p;
    for (V& q : p) q = {random(-1, 1), random(-1, 1)};
    const double angle = random(0, 6), scale = std::exp(random(-8, 8));
    const auto map = [&](V q) {
      return V{scale * (std::cos(angle) * q.x - std::sin(angle) * q.y) + 3, scale * (std::sin(angle) * q.x + std::cos(angle) * q.y) - 2};
    };
    for (const MetricInfo& entry : metric_table()) {
      const double q = triangle_quality(entry.metric, p[0], p[1], p[2]);
      EXPECT_NEAR(triangle_quality(entry.metric, p[1], p[2], p[0]), q, 1e-12) << entry.name;
      EXPECT_NEAR(triangle_quality(entry.metric, map(p[0]), map(p[1]), map(p[2])), q, 1e-6) << entry.name;
      EXPECT_NEAR(triangle_quality(entry.metric, p[0], p[2], p[1]), -q, 1e-12) << entry.name;
      if (!entry.defined_for(ElementKind::Quadrilateral)) continue;
      const double quad = quadrilateral_quality(entry.metric, p);
      EXPECT_NEAR(quadrilateral_quality(entry.metric, {p[1], p[2], p[3], p[0]}), quad, 1e-12) << entry.name;
    }
  }
}

TEST(MetricTable, NamesAreUniqueAndParse) {
  for (const MetricInfo& entry : metric_table()) {
    EXPECT_EQ(parse_metric(entry.name), entry.metric);
    EXPECT_EQ(info(entry.metric).name, entry.name);
    EXPECT_GT(entry.acceptable, 0.0);
    EXPECT_LT(entry.acceptable, entry.highest);
  }
  EXPECT_THROW((void)parse_metric("nonsense"), UsageError);
}

}  // namespace
}  // namespace dmoscope
