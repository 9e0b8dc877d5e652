#pragma once
// Sparse symmetric positive definite systems of D x D blocks, one row of blocks a vertex.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// A graph's edges in both directions, without loops: the neighbours of vertex i, ascending, are
/// neighbours[offsets[i]] to neighbours[offsets[i + 1]]. offsets: one more than there are vertices.
struct Adjacency {
  std::vector<Index> offsets{0};
  std::vector<Index> neighbours;
  [[nodiscard]] std::span<const Index> of(Index vertex) const {
    return {neighbours.data() + offsets[vertex], neighbours.data() + offsets[vertex + 1]};
  }
};

/// An order of elimination that keeps the factor sparse: nested dissection (George 1973). Each part is halved by its longest coordinate
/// and by a breadth-first search, and the smaller of the two separators is taken. `places`: about where each vertex stands. Returns the
/// vertices in that order; ties are broken by index.
template <int D>
[[nodiscard]] std::vector<Index> nested_dissection(const Adjacency& graph, std::span<const std::array<double, D>> places);

/// The matrix and its Cholesky factor, row of blocks by row of blocks (up-looking, along the elimination tree: Davis 2006, chapter 4). All
/// sums have a fixed order, so the same bits come out everywhere.
template <int D>
class BlockCholesky {
 public:
  using Block = std::array<double, static_cast<std::size_t>(D) * D>;  // row by row
  /// Where a block of the matrix is kept, and whether transposed.
  struct Slot {
    Index block = kNoIndex;
    bool transposed = false;
  };

  /// `graph`: which blocks off the diagonal are not 0. `places`: see nested_dissection.
  BlockCholesky(const Adjacency& graph, std::span<const std::array<double, D>> places);
  /// Of row i and column j, which must be the same vertex or neighbours.
  [[nodiscard]] Slot slot(Index i, Index j) const;

  /// Sets the matrix to 0.
  void clear();
  /// Adds to block (i, j), and so to (j, i); on the diagonal `block` must be symmetric.
  void add(Slot slot, const Block& block);
  /// The diagonal block of a vertex.
  [[nodiscard]] Block& diagonal(Index vertex) { return values_[place_[vertex]]; }
  /// Replaces the last factor. Returns false where the matrix is not positive definite; there is no factor then.
  [[nodiscard]] bool factorise();
  /// Solves for a right-hand side, in place: D numbers a vertex. After a factorise() that returned true.
  void solve(std::span<double> b) const;
  [[nodiscard]] std::size_t factor_blocks() const noexcept { return factor_.size(); }

 private:
  static constexpr std::size_t kD = D;
  void index_rows(const Adjacency& graph);
  void find_tree();
  /// The columns of the factor's row i, ascending in the tree, to stack_[first..n); returns first. Spreads the row's blocks.
  [[nodiscard]] std::size_t reach(Index i);
  [[nodiscard]] bool factorise_row(Index i, std::size_t top);

  std::vector<Index> order_, place_;          // vertex of each row, row of each vertex
  std::vector<Index> row_offsets_, columns_;  // blocks of the matrix left of the diagonal
  std::vector<Block> values_;                 // the diagonal, then those
  std::vector<Index> parent_;                 // in the elimination tree
  std::vector<std::size_t> column_offsets_;   // of the factor
  std::vector<Index> factor_rows_;            // of its blocks below the diagonal, column by column
  std::vector<Block> factor_, factor_diagonal_;
  // Room to work in.
  std::vector<std::size_t> filled_;
  std::vector<Index> mark_, stack_, path_;
  std::vector<Block> spread_;
  mutable std::vector<double> permuted_;
};

}  // namespace dmoscope
