// Gradients by dual numbers against differences of high order, and by hand.

#include "core/numeric/dual.h"

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

/// The derivative of f at 0 by central differences of sixth order; none if two widths do not agree, as at a kink.
template <class F>
std::optional<double> derivative(const F& f) {
  const auto at = [&f](double h) { return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h); };
  const double wide = at(2e-3), narrow = at(1e-3);
  if (!(std::fabs(wide - narrow) < 1e-8 * (1 + std::fabs(narrow)))) return std::nullopt;
  return narrow;
}

/// Checks the gradient. quality(p): of an element with one corner at p, in any scalar.
template <class Quality>
int expect_gradient(const Quality& quality, V p, std::string_view name) {
  const Dual exact = quality(variable(p));
  EXPECT_EQ(exact.value, quality(p)) << name << ": the same value as in double";
  const auto by_x = derivative([&](double h) { return quality(V{p.x + h, p.y}); });
  const auto by_y = derivative([&](double h) { return quality(V{p.x, p.y + h}); });
  if (!by_x || !by_y) return 0;
  EXPECT_NEAR(exact.by.x, *by_x, 1e-8 * (1 + std::fabs(*by_x))) << name;
  EXPECT_NEAR(exact.by.y, *by_y, 1e-8 * (1 + std::fabs(*by_y))) << name;
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

/// A volume element with one corner at p, in any scalar.
template <class R, class Element>
Element with(const std::array<Vec3, 8>& corners, std::size_t moving, Vec3Of<R> p) {
  const auto at = [&](std::size_t i) {
    const Vec3 c = corners[i];
    return i == moving ? p : Vec3Of<R>{R(c.x), R(c.y), R(c.z)};
  };
  if constexpr (std::is_same_v<Element, formulas::Tetrahedron<Vec3Of<R>>>) {
    return Element(at(0), at(1), at(3), at(4));
  } else {
    Element element{};
    for (std::size_t i = 0; i < element.at.size(); ++i) element.at[i] = at(i);
    return element;
  }
}

template <Metric M, template <class> class Element>
int expect_volume_gradient(const std::array<Vec3, 8>& corners, std::size_t moving) {
  const Vec3 p = corners[moving];
  const auto quality = [&]<class R>(Vec3Of<R> q) { return formulas::metric<M>(with<R, Element<Vec3Of<R>>>(corners, moving, q)); };
  const SolidDual exact = quality(variable(p));
  EXPECT_EQ(exact.value, quality(p)) << info(M).name << ": the same value as in double";
  const auto by = [&](Vec3 axis) { return derivative([&](double h) { return quality(p + h * axis); }); };
  const auto x = by({1, 0, 0}), y = by({0, 1, 0}), z = by({0, 0, 1});
  if (!x || !y || !z) return 0;
  EXPECT_NEAR(exact.by.x, *x, 1e-8 * (1 + std::fabs(*x))) << info(M).name;
  EXPECT_NEAR(exact.by.y, *y, 1e-8 * (1 + std::fabs(*y))) << info(M).name;
  EXPECT_NEAR(exact.by.z, *z, 1e-8 * (1 + std::fabs(*z))) << info(M).name;
  return 1;
}

TEST(Dual, GivesTheGradientOfEveryMetricOfVolumes) {
  testing::Random random(12);
  for (const MetricInfo& entry : metric_table()) {
    if (!entry.defined_for(ElementKind::Tetrahedron)) continue;
    const bool others = entry.defined_for(ElementKind::Hexahedron);
    int tetrahedra = 0, hexahedra = 0;
    for (int trial = 0; trial < 100; ++trial) {
      std::array<Vec3, 8> p{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
      for (Vec3& q : p) q = q + Vec3{random(-0.2, 0.2), random(-0.2, 0.2), random(-0.2, 0.2)};
      formulas::with_volume_metric(entry.metric, [&]<Metric M>() {
        constexpr std::array<std::size_t, 4> kCorners{0, 1, 3, 4};
        tetrahedra += expect_volume_gradient<M, formulas::Tetrahedron>(p, kCorners[static_cast<std::size_t>(trial % 4)]);
        if constexpr (formulas::kDefinedForCorners<M>)
          hexahedra += expect_volume_gradient<M, formulas::Hexahedron>(p, static_cast<std::size_t>(trial % 8));
      });
    }
    EXPECT_GT(tetrahedra, 70) << entry.name;
    EXPECT_TRUE(!others || hexahedra > 70) << entry.name << ' ' << hexahedra;
  }
}

TEST(Dual, ByHand) {
  const D p = variable(V{3, -4});
  const Dual length = sqrt(dot(p, p));
  EXPECT_DOUBLE_EQ(length.value, 5);
  EXPECT_DOUBLE_EQ(length.by.x, 0.6);
  EXPECT_DOUBLE_EQ(length.by.y, -0.8);
  const Dual angle = atan2(p.y, p.x);
  EXPECT_DOUBLE_EQ(angle.by.x, 4.0 / 25);
  EXPECT_DOUBLE_EQ(angle.by.y, 3.0 / 25);
  const Dual quotient = p.x / p.y;
  EXPECT_DOUBLE_EQ(quotient.by.x, -0.25);
  EXPECT_DOUBLE_EQ(quotient.by.y, -3.0 / 16);
  const Dual root = cube_root(Dual(-8, {1, 3}));
  EXPECT_DOUBLE_EQ(root.value, -2);
  EXPECT_DOUBLE_EQ(root.by.x, 1.0 / 12);
  EXPECT_DOUBLE_EQ(root.by.y, 3.0 / 12);
  EXPECT_DOUBLE_EQ(min(p.x, p.y).by.y, 1);
  EXPECT_DOUBLE_EQ(max(p.x, p.y).by.x, 1);
  EXPECT_DOUBLE_EQ(abs(p.y).by.y, -1);
  for (const Dual nothing : {sqrt(Dual(0, {1, 1})), cube_root(Dual(0, {1, 1})), atan2(Dual(0, {1, 1}), Dual(0, {1, 1}))}) {
    EXPECT_EQ(nothing.by.x, 0);
    EXPECT_EQ(nothing.by.y, 0);
  }
}

}  // namespace
}  // namespace dmoscope
