#pragma once
// Newton system of a problem over elements: each one's blocks, one a pair of its corners, summed up by the free vertices.

#include <array>
#include <type_traits>
#include <vector>

#include "core/joint/block_cholesky.h"
#include "core/joint/block_conjugate.h"
#include "core/joint/foldover_free.h"

namespace dmoscope {

template <int D>
class ElementBlocks {
 public:
  static constexpr std::size_t kD = D, kMost = 8;
  using Block = typename BlockCholesky<D>::Block;
  using Element = typename FoldoverFreeProblem<D>::Element;
  /// Derivatives of a function of an element's corners; the block of two corners k >= l is at k (k + 1) / 2 + l, rows by k.
  struct Derivatives {
    std::array<std::array<double, kD>, kMost> gradient{};
    std::array<Block, kMost*(kMost + 1) / 2> hessian{};
  };

  /// The problem must outlive it.
  ElementBlocks(const FoldoverFreeProblem<D>& problem, ThreadPool* pool);

  void clear();
  /// Adds the derivatives of an element's function to matrix and gradient.
  void add(std::size_t element, const Derivatives& derivatives);
  /// Solves for the step from -gradient, with `damping` times the diagonal added, in directions that vertices can go. False: the matrix is
  /// not positive definite.
  [[nodiscard]] bool solve(double damping, std::vector<double>& step);
  /// Gradient, D numbers a free vertex.
  [[nodiscard]] const std::vector<double>& gradient() const noexcept { return gradient_; }

 private:
  [[nodiscard]] bool is_bound(Index vertex) const { return problem_.path != nullptr && problem_.path->bound()[vertex] != 0; }
  void project(Index row, Index column, Block& block) const;
  void project(std::vector<double>& vector) const;
  void hold();

  const FoldoverFreeProblem<D>& problem_;
  /// Matrix; a volume's factor would be dense, so it is not factorised.
  std::conditional_t<D == 2, BlockCholesky<D>, BlockConjugate<D>> matrix_;
  std::vector<typename BlockCholesky<D>::Slot> slots_;  // slots of each element's pairs of free corners, one element after another
  std::vector<std::size_t> first_slot_;                 // offset in slots_, by element
  std::vector<double> gradient_;
};

}  // namespace dmoscope
