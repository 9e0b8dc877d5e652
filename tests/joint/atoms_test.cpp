// Atoms of an element: their least is its quality as the program judges it, and their derivatives are those of their values.

#include "core/joint/atoms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/numeric/product_log.h"
#include "core/numeric/semidefinite.h"
#include "tests/joint/elements.h"

namespace dmoscope {
namespace {

constexpr std::array kKinds{ElementKind::Triangle,   ElementKind::Quadrilateral, ElementKind::Tetrahedron,
                            ElementKind::Hexahedron, ElementKind::Wedge,         ElementKind::Pyramid};

/// Calls f(kind, metric) for all pairs that joint moves support.
template <class F>
int for_all_supported(F f) {
  int count = 0;
  for (const MetricInfo& row : metric_table())
    for (const ElementKind kind : kKinds) {
      if (!joint_supports(row.metric, kind_set(kind))) continue;
      SCOPED_TRACE(std::string(row.name) + " of " + std::string(info(kind).plural));
      f(kind, row.metric);
      ++count;
    }
  return count;
}

template <int D>
double least_atom(const Mesh& mesh, Metric metric) {
  const AtomFunction<D> function(metric);
  double most = 0.0;
  for (const Atom<D>& atom : testing::atoms_of<D>(mesh, metric))
    most = std::max(most, function.value(atom, testing::edges_of<D>(atom, mesh.positions), 1.0));
  return 1.0 / most;
}

TEST(Atoms, LeastOfAnElementIsItsQuality) {
  testing::Random random(1);
  const int pairs = for_all_supported([&](ElementKind kind, Metric metric) {
    int sound = 0;
    for (int i = 0; i < 200; ++i) {
      const Mesh mesh = testing::random_element(kind, 0.35, random);
      const Geometry geometry = testing::geometry_of(kind);
      const QualityContext context{mesh, geometry};
      const double judged = element_quality(context, mesh.positions, metric, 0);
      const double least = info(kind).dimension == 3 ? least_atom<3>(mesh, metric) : least_atom<2>(mesh, metric);
      if (smallest_jacobian(context, mesh.positions, 0) <= 0.0) {
        EXPECT_EQ(least, 0.0);  // 1 / infinity
        continue;
      }
      ++sound;
      EXPECT_NEAR(least, judged, 1e-13);
    }
    EXPECT_GT(sound, 50);
  });
  EXPECT_EQ(pairs, 6 + 1 + 2 + 2 + 1 + 6 + 2 + 5);  // in the order of the metrics, rectangularity left out
}

TEST(Atoms, IdealElementsAreWorthOne) {
  for_all_supported([&](ElementKind kind, Metric metric) {
    testing::Random random(2);
    const Mesh mesh = testing::random_element(kind, 0.0, random);
    EXPECT_NEAR(info(kind).dimension == 3 ? least_atom<3>(mesh, metric) : least_atom<2>(mesh, metric), 1.0, 1e-14);
  });
}

TEST(Atoms, WhatCannotBeSplitSaysWhy) {
  EXPECT_THAT(joint_obstacle(Metric::Rectangularity, kind_set(ElementKind::Triangle)), ::testing::HasSubstr("best"));
  EXPECT_THAT(joint_obstacle(Metric::MeanRatioArea, kind_set(ElementKind::Quadrilateral)), ::testing::HasSubstr("concave"));
  EXPECT_THAT(joint_obstacle(Metric::RadiusRatio, kind_set(ElementKind::Wedge)), ::testing::HasSubstr("not defined for wedges"));
  EXPECT_EQ(joint_obstacle(Metric::MeanRatio, 0x3f), "");
}

/// Expects that no eigenvalue is below 0: x' H x for many x.
template <int D>
void expect_semidefinite(const AtomFunction<D>& function, const Atom<D>& atom, const AtomEdges<D>& edges, testing::Random& random) {
  constexpr std::size_t kCount = AtomDerivatives<D>::kCount;
  AtomDerivatives<D> at;
  function.derive(atom, edges, 1.0, Curvature::Convex, at);
  double scale = 1e-3;
  for (const double h : at.hessian) scale = std::max(scale, std::fabs(h));
  for (int i = 0; i < 20; ++i) {
    std::array<double, kCount> x{};
    for (double& v : x) v = random(-1.0, 1.0);
    double form = 0.0;
    for (std::size_t r = 0; r < kCount; ++r)
      for (std::size_t c = 0; c < kCount; ++c) form += x[r] * at.hessian[r * kCount + c] * x[c];
    EXPECT_GE(form, -1e-11 * scale);
  }
}

template <int D>
void expect_derivatives_of(const Mesh& mesh, Metric metric, testing::Random& random) {
  const AtomFunction<D> quality(metric);
  for (const Atom<D>& atom : testing::atoms_of<D>(mesh, metric)) {
    const AtomEdges<D> edges = testing::edges_of<D>(atom, mesh.positions);
    if (quality.value(atom, edges, 1.0) > 10.0) continue;
    testing::expect_derivatives<D>(quality, atom, edges, 1.0);
    expect_semidefinite<D>(quality, atom, edges, random);
  }
}

TEST(Atoms, DerivativesAreThoseOfTheValues) {
  testing::Random random(3);
  for_all_supported([&](ElementKind kind, Metric metric) {
    for (int i = 0; i < 3; ++i) {
      const Mesh mesh = testing::random_element(kind, 0.25, random);
      if (info(kind).dimension == 3)
        expect_derivatives_of<3>(mesh, metric, random);
      else
        expect_derivatives_of<2>(mesh, metric, random);
    }
  });
}

TEST(Semidefinite, TakesAwayWhatIsNegativeAndNothingElse) {
  // Takes a matrix with eigenvalues 3 along (1, 1) and -1 along (1, -1).
  std::array<double, 4> a{1.0, 2.0, 2.0, 1.0};
  make_semidefinite<2>(a);
  for (const double x : a) EXPECT_NEAR(x, 1.5, 1e-15);
  std::array<double, 4> sound{2.0, 1.0, 1.0, 2.0};
  make_semidefinite<2>(sound);
  EXPECT_EQ(sound, (std::array{2.0, 1.0, 1.0, 2.0}));
}

TEST(ProductLog, IsTheSumOfLogarithms) {
  testing::Random random(4);
  ProductLog product;
  EXPECT_EQ(product.value(), 0.0);
  long double sum = 0.0L;
  for (int i = 0; i < 2000; ++i) {
    const double factor = std::exp(random(-300.0, 280.0));
    product.multiply(factor);
    sum += std::log(static_cast<long double>(factor));
    ASSERT_NEAR(product.value(), static_cast<double>(sum), 1e-12 * (1.0 + std::fabs(static_cast<double>(sum))));
  }
}

}  // namespace
}  // namespace dmoscope
