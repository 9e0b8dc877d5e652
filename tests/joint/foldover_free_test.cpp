// Places at which elements are watched while they untangle, and the system that moves their vertices.

#include "core/joint/foldover_free.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/block_conjugate.h"
#include "core/joint/determinant_samples.h"
#include "core/joint/mean_ratio_atom.h"
#include "core/quality/validity.h"
#include "tests/joint/elements.h"

namespace dmoscope {
namespace {
namespace foldover_free {

using testing::Random;

template <int D>
MatrixOfColumns<D> matrix_at(const DeterminantSample<D>& sample, const std::vector<Vec3>& corners) {
  MatrixOfColumns<D> result;
  for (std::size_t i = 0; i < sample.count; ++i) {
    const Vec3 p = corners[sample.corners[i]];
    const std::array<double, 3> at{p.x, p.y, p.z};
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t r = 0; r < D; ++r) result.column[c][r] += sample.slopes[i][c] * at[r];
  }
  result.measure();
  return result;
}

template <int D>
void expect_ideal(ElementKind kind) {
  Random random(1);
  const Mesh mesh = testing::random_element(kind, 0.0, random);
  for (const auto& samples : {corner_samples<D>(kind), inner_samples<D>(kind)})
    for (const DeterminantSample<D>& sample : samples) {
      const auto t = matrix_at<D>(sample, mesh.positions);
      EXPECT_NEAR(t.square, D, 1e-12) << info(kind).name;
      EXPECT_NEAR(t.determinant, 1.0, 1e-12) << info(kind).name;
      for (std::size_t c = 0; c < D; ++c) {
        double sum = 0.0;
        for (std::size_t i = 0; i < sample.count; ++i) sum += sample.slopes[i][c];
        EXPECT_NEAR(sum, 0.0, 1e-14);
      }
    }
}

TEST(DeterminantSamples, AreOneInIdealElements) {
  expect_ideal<2>(ElementKind::Triangle);
  expect_ideal<2>(ElementKind::Quadrilateral);
  for (const ElementKind kind : {ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid})
    expect_ideal<3>(kind);
  EXPECT_EQ(corner_samples<3>(ElementKind::Hexahedron).size(), 8U);
  EXPECT_EQ(inner_samples<3>(ElementKind::Hexahedron).size(), 19U);
  EXPECT_EQ(inner_samples<3>(ElementKind::Wedge).size(), 3U);
  EXPECT_TRUE(inner_samples<3>(ElementKind::Pyramid).empty());
  EXPECT_TRUE(inner_samples<2>(ElementKind::Quadrilateral).empty());
}

/// Compares with derivatives of place_in() by differences.
TEST(DeterminantSamples, InnerOnesAreThoseOfTheTrilinearMap) {
  Random random(2);
  const Mesh mesh = testing::random_element(ElementKind::Hexahedron, 0.3, random);
  formulas::Hexahedron<Vec3> hexahedron{};
  std::copy(mesh.positions.begin(), mesh.positions.end(), hexahedron.at.begin());
  const auto samples = inner_samples<3>(ElementKind::Hexahedron);
  std::size_t next = 0;
  for (int i = 0; i < 27; ++i) {
    const std::array<int, 3> halves{i / 9, i / 3 % 3, i % 3};
    if (std::ranges::find(halves, 1) == halves.end()) continue;
    const Vec3 at{0.5 * halves[0], 0.5 * halves[1], 0.5 * halves[2]};
    constexpr double kStep = 1e-5;
    const auto slope = [&](Vec3 way) {
      return (0.5 / kStep) * (place_in(hexahedron, at + kStep * way) - place_in(hexahedron, at - kStep * way));
    };
    const double expected = dot(cross(slope({1.0, 0.0, 0.0}), slope({0.0, 1.0, 0.0})), slope({0.0, 0.0, 1.0}));
    EXPECT_NEAR(matrix_at<3>(samples[next++], mesh.positions).determinant, expected, 1e-8);
  }
  EXPECT_EQ(next, samples.size());
}

/// Uses a matrix of random blocks that are outweighed by the diagonal.
TEST(BlockConjugate, SolvesAsTheBlockCholeskyDoes) {
  constexpr Index kVertices = 700;
  Random random(3);
  std::vector<std::vector<Index>> neighbours(kVertices);
  for (Index i = 0; i < kVertices; ++i)
    for (const Index step : {1U, 7U, 60U})
      if (i + step < kVertices) {
        neighbours[i].push_back(i + step);
        neighbours[i + step].push_back(i);
      }
  Adjacency graph;
  for (auto& each : neighbours) {
    std::ranges::sort(each);
    graph.neighbours.insert(graph.neighbours.end(), each.begin(), each.end());
    graph.offsets.push_back(static_cast<Index>(graph.neighbours.size()));
  }
  const std::vector<std::array<double, 3>> places(kVertices);
  ThreadPool two(2);
  BlockCholesky<3> cholesky(graph, places);
  BlockConjugate<3> alone(graph), together(graph, &two);
  cholesky.clear(), alone.clear(), together.clear();
  const auto add = [&](Index i, Index j, const std::array<double, 9>& block) {
    cholesky.add(cholesky.slot(i, j), block);
    alone.add(alone.slot(i, j), block);
    together.add(together.slot(i, j), block);
  };
  for (Index i = 0; i < kVertices; ++i) {
    add(i, i, {9.0, 1.0, 0.5, 1.0, 8.0, 0.2, 0.5, 0.2, 7.0});
    for (const Index j : graph.of(i)) {
      if (j > i) continue;
      std::array<double, 9> block{};
      for (double& x : block) x = random(-0.4, 0.4);
      random() < 0.5 ? add(i, j, block) : add(j, i, block);
    }
  }
  std::vector<double> b(3 * std::size_t{kVertices});
  for (double& x : b) x = random(-1.0, 1.0);
  std::vector<double> exact = b, one = b, both = b;
  ASSERT_TRUE(cholesky.factorise() && alone.factorise() && together.factorise());
  cholesky.solve(exact);
  alone.solve(one);
  together.solve(both);
  EXPECT_EQ(one, both) << "the same bits by any threads";
  double error = 0.0, size = 0.0, along = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error += (one[i] - exact[i]) * (one[i] - exact[i]);
    size += exact[i] * exact[i];
    along += one[i] * b[i];
  }
  EXPECT_LT(std::sqrt(error / size), 0.02);
  EXPECT_GT(along, 0.0);
}

TEST(BlockConjugate, RefusesWhatIsNotPositive) {
  Adjacency graph;
  graph.offsets = {0, 0};
  BlockConjugate<2> matrix(graph);
  matrix.clear();
  matrix.add(matrix.slot(0, 0), {1.0, 2.0, 2.0, 1.0});
  EXPECT_FALSE(matrix.factorise());
}

}  // namespace foldover_free
}  // namespace
}  // namespace dmoscope
