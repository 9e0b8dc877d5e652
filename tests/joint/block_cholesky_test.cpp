// Block Cholesky factorisation against a dense one.

#include "core/joint/block_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using Edges = std::vector<std::pair<Index, Index>>;

Adjacency graph_of(Index n, const Edges& edges) {
  std::vector<std::vector<Index>> neighbours(n);
  for (const auto& [i, j] : edges) {
    if (i == j) continue;
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
  }
  return adjacency_of(std::move(neighbours));
}

/// Random graph, with parts that are not connected.
Adjacency random_graph(Index n, int count, testing::Random& random) {
  Edges edges;
  for (int e = 0; e < count; ++e) {
    const auto i = static_cast<Index>(random() * n), j = static_cast<Index>(random() * n);
    if ((i % 7 == 0) == (j % 7 == 0)) edges.emplace_back(i, j);
  }
  return graph_of(n, edges);
}

Adjacency chain(Index n) {
  Edges edges;
  for (Index i = 1; i < n; ++i) edges.emplace_back(i - 1, i);
  return graph_of(n, edges);
}
Adjacency star(Index n) {
  Edges edges;
  for (Index i = 1; i < n; ++i) edges.emplace_back(0, i);
  return graph_of(n, edges);
}
Adjacency complete(Index n) {
  Edges edges;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j) edges.emplace_back(i, j);
  return graph_of(n, edges);
}
/// Lattices of triangles that do not touch.
Adjacency lattices(Index side, Index count) {
  Edges edges;
  for (Index l = 0; l < count; ++l)
    for (Index j = 0; j < side; ++j)
      for (Index i = 0; i < side; ++i) {
        const Index v = (l * side + j) * side + i;
        if (i > 0) edges.emplace_back(v - 1, v);
        if (j > 0) edges.emplace_back(v - side, v);
        if (i > 0 && j > 0) edges.emplace_back(v - side - 1, v);
      }
  return graph_of(side * side * count, edges);
}

/// Symmetric matrix, by rows.
class Dense {
 public:
  explicit Dense(std::size_t n) : n_(n), a_(n * n, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  /// Leaves the factor in the lower half.
  void factorise() {
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = j; i < n_; ++i) {
        double sum = (*this)(i, j);
        for (std::size_t k = 0; k < j; ++k) sum -= (*this)(i, k) * (*this)(j, k);
        (*this)(i, j) = i == j ? std::sqrt(sum) : sum / (*this)(j, j);
      }
  }
  void solve(std::vector<double>& b) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t k = 0; k < i; ++k) b[i] -= (*this)(i, k) * b[k];
      b[i] /= (*this)(i, i);
    }
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t k = i + 1; k < n_; ++k) b[i] -= (*this)(k, i) * b[k];
      b[i] /= (*this)(i, i);
    }
  }

 private:
  std::size_t n_;
  std::vector<double> a_;
};

/// Random places, which tell little of the graph.
template <int D>
std::vector<std::array<double, D>> random_places(const Adjacency& graph, testing::Random& random) {
  std::vector<std::array<double, D>> places(graph.offsets.size() - 1);
  for (auto& place : places)
    for (double& x : place) x = random();
  return places;
}

/// Fills a matrix with random blocks, and so much on the diagonal that it is positive definite. add(i, j, block) takes each once.
template <int D, class Add>
void fill(const Adjacency& graph, testing::Random& random, Add add) {
  for (Index i = 0; i + 1 < graph.offsets.size(); ++i) {
    typename BlockCholesky<D>::Block diagonal{};
    for (std::size_t r = 0; r < D; ++r)
      for (std::size_t c = 0; c <= r; ++c) diagonal[r * D + c] = diagonal[c * D + r] = random(-0.3, 0.3);
    for (std::size_t r = 0; r < D; ++r) diagonal[r * D + r] = 2.0 + D * static_cast<double>(graph.of(i).size());
    add(i, i, diagonal);
    for (const Index j : graph.of(i)) {
      if (random() < 0.5) continue;  // some from above the diagonal, some from below, some twice
      typename BlockCholesky<D>::Block block{};
      for (double& x : block) x = random(-0.4, 0.4);
      add(i, j, block);
    }
  }
}

template <int D>
void expect_solves(const Adjacency& graph, std::uint64_t seed) {
  testing::Random random(seed);
  const auto places = random_places<D>(graph, random);
  const std::size_t n = places.size() * D;
  BlockCholesky<D> cholesky(graph, places);
  Dense dense(n);
  cholesky.clear();
  fill<D>(graph, random, [&](Index i, Index j, const typename BlockCholesky<D>::Block& block) {
    cholesky.add(cholesky.slot(i, j), block);
    for (std::size_t r = 0; r < D; ++r)
      for (std::size_t c = 0; c < D; ++c) {
        dense(i * D + r, j * D + c) += block[r * D + c];
        if (i != j) dense(j * D + c, i * D + r) += block[r * D + c];
      }
  });
  ASSERT_TRUE(cholesky.factorise());
  ASSERT_TRUE(cholesky.factorise());  // the second has nothing of the first
  std::vector<double> b(n);
  for (double& v : b) v = random(-1.0, 1.0);
  std::vector<double> x = b, expected = b;
  cholesky.solve(x);
  dense.factorise();
  dense.solve(expected);
  for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(x[i], expected[i], 1e-12);
}

template <int D>
void expect_solves_all_shapes(std::uint64_t seed) {
  testing::Random random(seed);
  expect_solves<D>(chain(1), seed);
  expect_solves<D>(chain(100), seed);
  expect_solves<D>(star(60), seed);
  expect_solves<D>(complete(D == 2 ? 140 : 90), seed);  // more columns than are eliminated at once
  expect_solves<D>(lattices(15, 1), seed);
  expect_solves<D>(lattices(6, 5), seed);
  expect_solves<D>(graph_of(20, {}), seed);
  expect_solves<D>(random_graph(60, 150, random), seed);
  expect_solves<D>(random_graph(9, 30, random), seed);
}

TEST(BlockCholesky, SolvesAsADenseOneDoes) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_solves_all_shapes<2>(seed);
    expect_solves_all_shapes<3>(seed);
  }
}

constexpr Index kSquare = 50;  // side of a lattice whose factor is worth threads

/// Solution for two right-hand sides, one after the other. `by_lattice`: places are those of lattices(kSquare, ...).
template <int D>
std::vector<double> solved(const Adjacency& graph, SimdLevel level, bool at_once, ThreadPool* pool = nullptr, bool by_lattice = false) {
  testing::Random random(7);
  auto places = random_places<D>(graph, random);
  if (by_lattice)
    for (std::size_t v = 0; v < places.size(); ++v)
      places[v][0] = static_cast<double>(v % kSquare), places[v][1] = static_cast<double>(v / kSquare);
  BlockCholesky<D> cholesky(graph, places, pool, level);
  cholesky.clear();
  fill<D>(graph, random, [&](Index i, Index j, const auto& block) { cholesky.add(cholesky.slot(i, j), block); });
  EXPECT_TRUE(cholesky.factorise());
  std::vector<double> b((graph.offsets.size() - 1) * D), c = b;
  for (double& v : b) v = random(-1.0, 1.0);
  for (double& v : c) v = random(-1.0, 1.0);
  if (at_once) {
    cholesky.solve(b, c);
  } else {
    cholesky.solve(b);
    cholesky.solve(c);
  }
  b.insert(b.end(), c.begin(), c.end());
  return b;
}

template <int D>
void expect_same_bits() {
  testing::Random random(3);
  for (const Adjacency& graph : {lattices(20, 2), complete(100), random_graph(200, 500, random), star(30)}) {
    const std::vector<double> expected = solved<D>(graph, SimdLevel::Baseline, false);
    for (const SimdLevel level : supported_simd_levels()) EXPECT_EQ(solved<D>(graph, level, true), expected) << name(level);
  }
}

TEST(BlockCholesky, HasTheSameBitsForAnySimdLevelAndForTwoSidesAtOnce) {
  expect_same_bits<2>();
  expect_same_bits<3>();
}

/// Expects, of an elimination with branches, that the matrix times the solution is the right-hand side.
template <int D>
void expect_small_residual(const Adjacency& graph, ThreadPool* pool) {
  testing::Random random(11);
  std::vector<std::array<double, D>> places(graph.offsets.size() - 1);
  for (std::size_t v = 0; v < places.size(); ++v)
    places[v][0] = static_cast<double>(v % kSquare), places[v][1] = static_cast<double>(v / kSquare);
  struct Entry {
    Index i, j;
    typename BlockCholesky<D>::Block block;
  };
  std::vector<Entry> entries;
  BlockCholesky<D> cholesky(graph, places, pool);
  cholesky.clear();
  fill<D>(graph, random, [&](Index i, Index j, const auto& block) {
    cholesky.add(cholesky.slot(i, j), block);
    entries.push_back({i, j, block});
  });
  ASSERT_TRUE(cholesky.factorise());
  std::vector<double> b(places.size() * D);
  for (double& v : b) v = random(-1.0, 1.0);
  std::vector<double> x = b;
  cholesky.solve(x);
  for (const auto& [i, j, block] : entries)
    for (std::size_t r = 0; r < D; ++r)
      for (std::size_t c = 0; c < D; ++c) {
        b[i * D + r] -= block[r * D + c] * x[j * D + c];
        if (i != j) b[j * D + c] -= block[r * D + c] * x[i * D + r];
      }
  for (const double left : b) ASSERT_NEAR(left, 0.0, 1e-12);
}

TEST(BlockCholesky, SolvesLargeSystemsOnOneThreadAndOnSeveral) {
  ThreadPool pool(3);
  for (ThreadPool* const threads : {static_cast<ThreadPool*>(nullptr), &pool}) {
    expect_small_residual<2>(lattices(kSquare, 1), threads);
    expect_small_residual<2>(lattices(kSquare, 3), threads);
    expect_small_residual<3>(lattices(kSquare, 1), threads);
  }
}

TEST(BlockCholesky, HasTheSameBitsForAnyThreads) {
  for (const bool one : {false, true}) {
    const Adjacency graph = one ? lattices(kSquare, 1) : lattices(kSquare, 3);
    const auto flat = solved<2>(graph, SimdLevel::Baseline, true, nullptr, true),
               solid = solved<3>(graph, SimdLevel::Baseline, true, nullptr, true);
    for (const unsigned threads : {2U, 3U, 5U}) {
      ThreadPool pool(threads);
      EXPECT_EQ(solved<2>(graph, best_simd_level(), true, &pool, true), flat) << threads;
      EXPECT_EQ(solved<3>(graph, best_simd_level(), true, &pool, true), solid) << threads;
    }
  }
}

/// The bad pivot is in each branch of the elimination in turn, on several threads.
TEST(BlockCholesky, RefusesABadPivotOnAnyThread) {
  const Adjacency graph = lattices(kSquare, 2);
  ThreadPool pool(3);
  std::vector<std::array<double, 2>> places(graph.offsets.size() - 1);
  for (std::size_t v = 0; v < places.size(); ++v) places[v] = {static_cast<double>(v % kSquare), static_cast<double>(v / kSquare)};
  BlockCholesky<2> cholesky(graph, places, &pool);
  std::vector<double> ones(places.size() * 2, 1.0);
  for (Index bad = 0; bad < places.size(); bad += 97) {
    cholesky.clear();
    for (Index v = 0; v < places.size(); ++v) cholesky.diagonal(v) = {1, 0, 0, 1};
    ASSERT_TRUE(cholesky.factorise());
    cholesky.diagonal(bad)[0] = -1.0;
    ASSERT_FALSE(cholesky.factorise()) << bad;
  }
  for (Index v = 0; v < places.size(); ++v) cholesky.diagonal(v) = {1, 0, 0, 1};
  ASSERT_TRUE(cholesky.factorise());
  std::vector<double> b = ones;
  cholesky.solve(b);
  EXPECT_EQ(b, ones);
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

/// The bad pivot is at any place of the matrix, and a factor that failed leaves no trace.
TEST(BlockCholesky, RefusesOneBadPivotAnywhere) {
  const Adjacency graph = lattices(12, 1);
  testing::Random random(5);
  const auto places = random_places<2>(graph, random);
  BlockCholesky<2> cholesky(graph, places);
  for (Index bad = 0; bad < places.size(); ++bad)
    for (const double pivot : {-1e-3, std::nan(""), std::numeric_limits<double>::infinity()}) {
      cholesky.clear();
      for (Index v = 0; v < places.size(); ++v) cholesky.diagonal(v) = {1, 0, 0, 1};
      cholesky.diagonal(bad)[3] = pivot;
      ASSERT_FALSE(cholesky.factorise());
    }
  cholesky.diagonal(static_cast<Index>(places.size() - 1))[3] = 4.0;
  ASSERT_TRUE(cholesky.factorise());
  std::vector<double> b(places.size() * 2, 1.0);
  cholesky.solve(b);
  for (std::size_t i = 0; i < b.size(); ++i) EXPECT_EQ(b[i], i + 1 < b.size() ? 1.0 : 0.25);
}

/// Compares with n^2 log n: on a lattice of n x n vertices the factor has some n^2 log n blocks; in the lattice's own order it would have
/// n^3.
TEST(BlockCholesky, DissectionKeepsTheFactorSparse) {
  constexpr Index kSide = 64;
  const Adjacency graph = lattices(kSide, 1);
  std::vector<std::array<double, 2>> places;
  for (Index v = 0; v < kSide * kSide; ++v) places.push_back({static_cast<double>(v % kSide), static_cast<double>(v / kSide)});
  EXPECT_LT((BlockCholesky<2>(graph, places).factor_blocks()), kSide * kSide * kSide / 2);
  std::vector<Index> order = nested_dissection<2>(graph, places);
  std::sort(order.begin(), order.end());
  for (Index v = 0; v < order.size(); ++v) ASSERT_EQ(order[v], v);  // each vertex once
}

}  // namespace
}  // namespace dmoscope
