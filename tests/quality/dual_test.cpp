// Gradients by dual numbers against differences of high order, and by hand.

#include "core/quality/dual.h"

#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "core/quality/formulas.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using V = Vec2<double>;
using D = Vec2<Dual>;

/// The derivative of f at 0 by central differences of sixth order; none where two widths do not agree, as at a kink.
template <class F>
std::optional<double> derivative(const F& f) {
  const auto at = [&f](double h) { return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h); };
  const double wide = at(2e-3), narrow = at(1e-3);
  if (!(std::fabs(wide - narrow) < 1e-8 * (1 + std::fabs(narrow)))) return std::nullopt;
  return narrow;
}

/// quality(p): of an element of which one corner is at p, in any scalar.
template <class Quality>
int expect_gradient(const Quality& quality, V p, std::string_view name) {
  const Dual exact = quality(variable(p));
  EXPECT_EQ(exact.value, quality(p)) << name << ": the same value as in double";
  const auto by_x = derivative([&](double h) { return quality(V{p.x + h, p.y}); });
  const auto by_y = derivative([&](double h) { return quality(V{p.x, p.y + h}); });
  if (!by_x || !by_y) return 0;
  EXPECT_NEAR(exact.dx, *by_x, 1e-8 * (1 + std::fabs(*by_x))) << name;
  EXPECT_NEAR(exact.dy, *by_y, 1e-8 * (1 + std::fabs(*by_y))) << name;
  return 1;
}

template <class R>
Vec2<R> as(V p) {
  return {R(p.x), R(p.y)};
}

TEST(Dual, GivesTheGradientOfEveryMetricAtEveryCornerOfEveryElement) {
  testing::Random random(11);
  for (const MetricInfo& entry : metric_table()) {
    int triangles = 0, quadrilaterals = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::array<V, 4> p{V{0, 0}, V{1, 0}, V{1, 1}, V{0, 1}};
      for (V& q : p) q = {q.x + random(-0.3, 0.3), q.y + random(-0.3, 0.3)};
      if (trial % 5 == 0) std::swap(p[1], p[2]);  // an inverted triangle, and a quadrilateral that is tied in a bow
      formulas::with_planar_metric(entry.metric, [&]<Metric M>() {
        const auto k = static_cast<std::size_t>(trial % 3);
        triangles += expect_gradient(
            [&]<class R>(Vec2<R> q) {
              std::array<Vec2<R>, 3> c{as<R>(p[0]), as<R>(p[1]), as<R>(p[2])};
              c[k] = q;
              return formulas::metric<M>(formulas::Triangle<Vec2<R>>(c[0], c[1], c[2]));
            },
            p[k], entry.name);
        if constexpr (formulas::kDefinedForQuadrilaterals<M, V>) {
          const auto n = static_cast<std::size_t>(trial % 4);
          quadrilaterals += expect_gradient(
              [&]<class R>(Vec2<R> q) {
                std::array<Vec2<R>, 4> c{as<R>(p[0]), as<R>(p[1]), as<R>(p[2]), as<R>(p[3])};
                c[n] = q;
                return formulas::metric<M>(formulas::Quadrilateral<Vec2<R>>(c[0], c[1], c[2], c[3]));
              },
              p[n], entry.name);
        }
      });
    }
    EXPECT_GT(triangles, 150) << entry.name;
    EXPECT_TRUE(!entry.defined_for(ElementKind::Quadrilateral) || quadrilaterals > 150) << entry.name << ' ' << quadrilaterals;
  }
}

TEST(Dual, ByHand) {
  const D p = variable({3, -4});
  const Dual length = sqrt(dot(p, p));
  EXPECT_DOUBLE_EQ(length.value, 5);
  EXPECT_DOUBLE_EQ(length.dx, 0.6);
  EXPECT_DOUBLE_EQ(length.dy, -0.8);
  const Dual angle = atan2(p.y, p.x);
  EXPECT_DOUBLE_EQ(angle.dx, 4.0 / 25);
  EXPECT_DOUBLE_EQ(angle.dy, 3.0 / 25);
  const Dual quotient = p.x / p.y;
  EXPECT_DOUBLE_EQ(quotient.dx, -0.25);
  EXPECT_DOUBLE_EQ(quotient.dy, -3.0 / 16);
  EXPECT_DOUBLE_EQ(min(p.x, p.y).dy, 1);
  EXPECT_DOUBLE_EQ(max(p.x, p.y).dx, 1);
  EXPECT_DOUBLE_EQ(abs(p.y).dy, -1);
  for (const Dual nothing : {sqrt(Dual(0, 1, 1)), atan2(Dual(0, 1, 1), Dual(0, 1, 1))}) {
    EXPECT_EQ(nothing.dx, 0);
    EXPECT_EQ(nothing.dy, 0);
  }
}

}  // namespace
}  // namespace dmoscope
