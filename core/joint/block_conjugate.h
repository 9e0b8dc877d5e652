#pragma once
// Conjugate gradients for sparse symmetric positive definite systems of D x D blocks that are too large to be factorised.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/joint/block_cholesky.h"

namespace dmoscope {

/// Matrix, and conjugate gradients preconditioned with the inverse of its diagonal blocks (Nocedal and Wright 2006, chapter 5), as far as a
/// Newton step needs them. Every sum has a fixed order: the same bits for any pool.
template <int D>
class BlockConjugate {
 public:
  using Block = typename BlockCholesky<D>::Block;  // row by row
  using Slot = typename BlockCholesky<D>::Slot;

  /// `graph`: which blocks off the diagonal are not 0. `pool`: must outlive it; null: the calling thread.
  explicit BlockConjugate(Adjacency graph, ThreadPool* pool = nullptr);
  /// Slot of row i and column j, which must be the same vertex or neighbours.
  [[nodiscard]] Slot slot(Index i, Index j) const;

  /// Sets the matrix to 0.
  void clear();
  /// Adds to block (i, j), and so to (j, i); on the diagonal `block` must be symmetric.
  void add(Slot slot, const Block& block);
  /// Diagonal block of a vertex.
  [[nodiscard]] Block& diagonal(Index vertex) { return diagonal_[vertex]; }
  /// Inverts the diagonal's blocks alone. Returns false where one is not positive definite.
  [[nodiscard]] bool factorise();
  /// Solves for a right-hand side, in place: D numbers a vertex. Ends at a small share of its size, or after some hundred iterations;
  /// either way the product with the right-hand side is positive.
  void solve(std::span<double> b) const;

 private:
  static constexpr std::size_t kD = D;
  using Vector = std::vector<double>;
  [[nodiscard]] double times(const Vector& x, Vector& y) const;

  Adjacency graph_;
  ThreadPool* pool_;
  std::vector<Index> mirror_;              // for each block off the diagonal, the one across it
  std::vector<Block> diagonal_, inverse_;  // diagonal blocks of the vertices
  std::vector<Block> values_;  // off the diagonal, in the order of the graph's neighbours; until factorise() those below it alone
};

}  // namespace dmoscope
