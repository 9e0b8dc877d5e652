#pragma once
// Turns inverted atoms the right way round by moving all free vertices together: a foldover-free map (Garanzha, Kaporin, Kudryavtseva,
// Protais, Ray and Sokolov 2021, "Foldover-free maps in 50 lines of code", ACM Transactions on Graphics 40(4)), by Newton's method.
//
// With T an atom's edges against the ideal ones and J its determinant, minimised is the sum of
//   (|T|^2 / D) / chi(J)^(2 / D) + theta (J^2 + 1) / chi(J),   chi(J) = (J + sqrt(epsilon^2 + J^2)) / 2,
// finite for any J while epsilon > 0, which falls towards 0: a wall at J = 0 that what is inverted can still pass.

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/joint/interior_point.h"

namespace dmoscope {

struct FoldoverFreeOptions {
  double theta = 1.0 / 128.0;  // weighs sizes against shapes
  int max_steps = 100;         // Newton steps
};

/// Where it stands after a Newton step.
template <int D>
struct FoldoverFreeIterate {
  const std::vector<std::array<double, D>>& displacements;
  int steps = 0;
  std::size_t inverted = 0;  // atoms with J <= 0
  double least = 0.0;        // least signed (mean ratio)^(D / 2)
};

template <int D>
struct FoldoverFreeSolution {
  /// With the fewest inverted atoms, and of these the best shape of the worst one, which is nowhere worse than at the start. All 0 where
  /// nothing is better than that.
  std::vector<std::array<double, D>> best;
  std::size_t start_inverted = 0, inverted = 0;  // atoms
  double start_least = 0.0, least = 0.0;
  int steps = 0;
};

/// `problem`: with a reference for each atom, the J that is wanted of it. `start`: the displacements to begin with; what is no worse than
/// none is told against none. Throws Cancelled within one Newton step of Progress::request_cancel(). Every sum has a fixed order.
template <int D>
[[nodiscard]] FoldoverFreeSolution<D> solve_foldover_free(const JointProblem<D>& problem, std::vector<std::array<double, D>> start,
                                                          const FoldoverFreeOptions& options,
                                                          const std::function<void(const FoldoverFreeIterate<D>&)>& on_step,
                                                          Progress& progress);

/// Displacements that take every free vertex to the mean of its neighbours: of the edges of atoms all at once, as of a net of equal
/// springs.
template <int D>
[[nodiscard]] std::vector<std::array<double, D>> sprung_displacements(const JointProblem<D>& problem);

}  // namespace dmoscope
