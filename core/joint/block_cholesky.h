#pragma once
// Cholesky factorisation of sparse symmetric positive definite systems of D x D blocks, one row of blocks a vertex.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/dense_front.h"
#include "core/joint/dense_solve.h"
#include "core/joint/nested_dissection.h"
#include "core/joint/supernodes.h"
#include "core/numeric/simd.h"

namespace dmoscope {

/// Matrix and its Cholesky factor, by the multifrontal method (Duff and Reid 1983; Liu 1992): from the leaves of the elimination tree on,
/// each supernode's columns are eliminated from a dense front, and the rest goes to its parent's. All sums have a fixed order, so the same
/// bits come out everywhere.
template <int D>
class BlockCholesky {
 public:
  using Block = std::array<double, static_cast<std::size_t>(D) * D>;  // row by row
  /// Place of a block in the matrix, and whether it is kept transposed.
  struct Slot {
    Index block = kNoIndex;
    bool transposed = false;
  };

  /// `graph`: which blocks off the diagonal are not 0. `places`: see nested_dissection. `pool`: threads for the factorisation, which must
  /// outlive it; null: the calling thread.
  BlockCholesky(const Adjacency& graph, std::span<const std::array<double, D>> places, ThreadPool* pool = nullptr,
                SimdLevel level = best_simd_level());
  /// Slot of row i and column j, which must be the same vertex or neighbours.
  [[nodiscard]] Slot slot(Index i, Index j) const;

  /// Sets the matrix to 0.
  void clear();
  /// Adds to block (i, j), and so to (j, i); on the diagonal `block` must be symmetric.
  void add(Slot slot, const Block& block);
  /// Diagonal block of a vertex.
  [[nodiscard]] Block& diagonal(Index vertex) { return values_[place_[vertex]]; }
  /// Replaces the last factor. Returns false where the matrix is not positive definite; there is no factor then.
  [[nodiscard]] bool factorise();
  /// Solves for a right-hand side, in place: D numbers a vertex. After a factorise() that returned true.
  void solve(std::span<double> b) const;
  /// Solves for two right-hand sides, in little more time than one takes, with the same bits as one by one.
  void solve(std::span<double> b, std::span<double> c) const;
  /// Number of blocks of the factor below the diagonal.
  [[nodiscard]] std::size_t factor_blocks() const noexcept;

 private:
  static constexpr std::size_t kD = D;
  /// Place of a supernode's numbers.
  struct Place {
    std::size_t pivots = 0;  // offset in factor_
    std::size_t rest = 0;    // offset in rests_, until its parent has taken it
  };
  /// Subtree of the elimination tree that needs nothing of the others until its root is done: nodes first to root.
  struct Branch {
    std::size_t first = 0, root = 0;
  };
  [[nodiscard]] bool is_alone() const { return pool_ == nullptr || pool_->size() == 1; }
  void index_columns(const Adjacency& graph);
  void find_branches();
  void place_fronts();
  [[nodiscard]] bool factorise_front(std::size_t s, std::vector<double>& room, ThreadPool* pool);
  void start_front(std::size_t s, const DenseFront& front) const;
  void add_rest(std::size_t child, const DenseFront& front) const;
  [[nodiscard]] DenseFront front(std::size_t s);
  /// Sum that a branch takes from the right-hand sides of the rows below its root; these are added up once all branches are done.
  template <std::size_t Q>
  struct Aside {
    Index end = 0;  // end of the branch's columns
    std::span<const Index> rows{};
    std::array<std::vector<double>, Q> sums{};
  };
  template <std::size_t Q>
  using Sides = std::array<std::vector<double>, Q>;
  template <std::size_t Q>
  void solve_all(const std::array<double*, Q>& b) const;
  template <std::size_t Q>
  void solve_lower_all(Sides<Q>& y) const;
  template <std::size_t Q>
  void solve_upper_all(Sides<Q>& y) const;
  template <std::size_t Q>
  void solve_lower_front(std::size_t s, Sides<Q>& y, std::vector<double>& room, Aside<Q>* aside) const;
  template <std::size_t Q>
  void solve_upper_front(std::size_t s, Sides<Q>& y, std::vector<double>& room) const;
  [[nodiscard]] FactorColumns columns_of(std::size_t s) const;

  SimdLevel level_;
  ThreadPool* pool_;
  SupernodeTree tree_;
  std::vector<Index> place_;                  // column of each vertex
  std::vector<Index> column_offsets_, rows_;  // blocks of the matrix below the diagonal
  std::vector<Index> front_rows_;             // number in the front of the row of each of these blocks
  std::vector<Block> values_;                 // blocks on the diagonal, then those below it
  std::vector<Place> places_;                 // places of the supernodes
  std::vector<std::vector<Index>> children_;  // children of the supernodes
  std::vector<Branch> branches_;              // ascending; each for one thread
  std::vector<std::size_t> trunk_;            // all other nodes, ascending
  std::vector<double> factor_, rests_;
  std::vector<std::vector<double>> rooms_;  // work space of each branch and of the trunk
};

}  // namespace dmoscope
