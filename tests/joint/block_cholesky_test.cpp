// The block Cholesky against a dense one.

#include "core/joint/block_cholesky.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

/// A random graph, some of it in parts that do not hang together, and places that tell little of it.
Adjacency random_graph(Index n, int edges, testing::Random& random) {
  std::vector<std::vector<Index>> neighbours(n);
  for (int e = 0; e < edges; ++e) {
    const auto i = static_cast<Index>(random() * n), j = static_cast<Index>(random() * n);
    if (i == j || (i % 7 == 0) != (j % 7 == 0)) continue;
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
  }
  Adjacency graph;
  for (std::vector<Index>& each : neighbours) {
    std::sort(each.begin(), each.end());
    each.erase(std::unique(each.begin(), each.end()), each.end());
    graph.neighbours.insert(graph.neighbours.end(), each.begin(), each.end());
    graph.offsets.push_back(static_cast<Index>(graph.neighbours.size()));
  }
  return graph;
}

/// A symmetric matrix, by rows.
class Dense {
 public:
  explicit Dense(std::size_t n) : n_(n), a_(n * n, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  [[nodiscard]] std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) y[i] += a_[i * n_ + j] * x[j];
    return y;
  }

 private:
  std::size_t n_;
  std::vector<double> a_;
};

template <int D>
void expect_solves(Index n, int edges, std::uint64_t seed) {
  testing::Random random(seed);
  const Adjacency graph = random_graph(n, edges, random);
  std::vector<std::array<double, D>> places(n);
  for (auto& place : places)
    for (double& x : place) x = random();
  BlockCholesky<D> cholesky(graph, places);
  Dense dense(static_cast<std::size_t>(n) * D);
  const auto add = [&](Index i, Index j, const typename BlockCholesky<D>::Block& block) {
    cholesky.add(cholesky.slot(i, j), block);
    for (std::size_t r = 0; r < D; ++r)
      for (std::size_t c = 0; c < D; ++c) {
        dense(i * D + r, j * D + c) += block[r * D + c];
        if (i != j) dense(j * D + c, i * D + r) += block[r * D + c];
      }
  };
  cholesky.clear();
  for (Index i = 0; i < n; ++i) {
    typename BlockCholesky<D>::Block diagonal{};
    for (std::size_t r = 0; r < D; ++r)
      for (std::size_t c = 0; c <= r; ++c) diagonal[r * D + c] = diagonal[c * D + r] = random(-0.3, 0.3);
    for (std::size_t r = 0; r < D; ++r) diagonal[r * D + r] = 2.0 + D * static_cast<double>(graph.of(i).size());
    add(i, i, diagonal);
    for (const Index j : graph.of(i)) {
      if (j < i && random() < 0.5) continue;  // half of them from below the diagonal
      if (j > i && random() < 0.5) continue;
      typename BlockCholesky<D>::Block block{};
      for (double& x : block) x = random(-0.9, 0.9);
      add(i, j, block);
    }
  }
  ASSERT_TRUE(cholesky.factorise());
  std::vector<double> x(static_cast<std::size_t>(n) * D);
  for (double& v : x) v = random(-1.0, 1.0);
  std::vector<double> b = dense.times(x);
  cholesky.solve(b);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(b[i], x[i], 1e-11);
}

TEST(BlockCholesky, SolvesWhatTheMatrixMultiplied) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    expect_solves<2>(1, 0, seed);
    expect_solves<2>(60, 150, seed);
    expect_solves<3>(70, 120, seed);
    expect_solves<3>(9, 30, seed);
  }
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  Adjacency graph{{0, 1, 2}, {1, 0}};
  const std::vector<std::array<double, 2>> places{{0, 0}, {1, 0}};
  BlockCholesky<2> cholesky(graph, places);
  cholesky.clear();
  cholesky.diagonal(0) = {1, 0, 0, 1};
  cholesky.diagonal(1) = {1, 0, 0, 1};
  cholesky.add(cholesky.slot(0, 1), {0.9, 0, 0, 0.9});
  EXPECT_TRUE(cholesky.factorise());
  cholesky.add(cholesky.slot(1, 0), {0.2, 0, 0, 0});
  EXPECT_FALSE(cholesky.factorise());
}

/// On a lattice of n x n vertices the factor has some n^2 log n blocks; in the lattice's own order it would have n^3.
TEST(BlockCholesky, DissectionKeepsTheFactorSparse) {
  constexpr Index kSide = 64;
  Adjacency graph;
  std::vector<std::array<double, 2>> places;
  for (Index j = 0; j < kSide; ++j)
    for (Index i = 0; i < kSide; ++i) {
      const Index v = j * kSide + i;
      if (j > 0) graph.neighbours.push_back(v - kSide);
      if (i > 0) graph.neighbours.push_back(v - 1);
      if (i + 1 < kSide) graph.neighbours.push_back(v + 1);
      if (j + 1 < kSide) graph.neighbours.push_back(v + kSide);
      graph.offsets.push_back(static_cast<Index>(graph.neighbours.size()));
      places.push_back({static_cast<double>(i), static_cast<double>(j)});
    }
  EXPECT_LT((BlockCholesky<2>(graph, places).factor_blocks()), kSide * kSide * kSide * 2 / 5);
  std::vector<Index> order = nested_dissection<2>(graph, places);
  std::sort(order.begin(), order.end());
  for (Index v = 0; v < order.size(); ++v) ASSERT_EQ(order[v], v);  // each vertex once
}

}  // namespace
}  // namespace dmoscope
