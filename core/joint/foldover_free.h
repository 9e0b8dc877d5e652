#pragma once
// Turns inverted elements the right way round by moving all free vertices together: a foldover-free map (Garanzha, Kaporin, Kudryavtseva,
// Protais, Ray and Sokolov 2021, "Foldover-free maps in 50 lines of code", ACM Transactions on Graphics 40(4)), by Newton's method.
//
// With T the map from an ideal element at a place of an element and J its determinant, it minimises the sum over places of
//   (|T|^2 / D) / chi(J)^(2 / D) + theta (J^2 + 1) / chi(J),   chi(J) = (J + sqrt(epsilon^2 + J^2)) / 2,
// finite for any J while epsilon > 0, which falls towards 0: a wall at J = 0 that inverted elements can still pass. The places are the
// corners; once these are sound, also inner places of elements that are not proved to be valid inside.

#include <array>
#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/joint/joint_ways.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Problem with vertices numbered for itself: first those that may move. Unknown are their displacements.
template <int D>
struct FoldoverFreeProblem {
  using Place = std::array<double, static_cast<std::size_t>(D)>;
  struct Element {
    ElementKind kind;
    std::array<Index, 8> vertices{};
    std::array<Place, 8> corners{};  // undisplaced positions, from any origin near them
    double weight = 1.0;             // factor of its part of the energy
  };
  std::size_t free_vertices = 0;
  std::vector<Place> places;      // rough positions of the free vertices
  std::vector<Element> elements;  // each with a free vertex
  double size = 1.0;              // wished determinant of an element, against an ideal one with edges of length 1
  JointWays<D>* path = nullptr;   // ways of the sliding vertices; null: all may go anywhere
};

struct FoldoverFreeOptions {
  bool springs_first = false;  // begins where springs along all edges would take the vertices
  double theta = 1.0 / 128.0;  // weighs sizes against shapes
  int max_steps = 150;         // Newton steps
  ThreadPool* pool = nullptr;  // null: the calling thread alone; the same bits for any
};

/// State after a Newton step.
template <int D>
struct FoldoverFreeIterate {
  const std::vector<std::array<double, D>>& displacements;
  int steps = 0;
  std::size_t inverted = 0;  // elements, at corners that can move, or not proved to be valid inside
  double least = 0.0;        // least signed (mean ratio)^(D / 2) of these corners
};

template <int D>
struct FoldoverFreeSolution {
  /// Displacements with the fewest inverted elements, and among these the best shape of the worst corner, which is nowhere worse than at
  /// the start. All 0 where nothing is better than that.
  std::vector<std::array<double, D>> best;
  std::size_t start_inverted = 0, inverted = 0;
  double start_least = 0.0, least = 0.0;
  int steps = 0;
};

/// Solves the problem. The undisplaced vertices count as the start. Throws Cancelled within one Newton step of Progress::request_cancel().
/// Every sum has a fixed order.
template <int D>
[[nodiscard]] FoldoverFreeSolution<D> solve_foldover_free(const FoldoverFreeProblem<D>& problem, const FoldoverFreeOptions& options,
                                                          const std::function<void(const FoldoverFreeIterate<D>&)>& on_step,
                                                          Progress& progress);

}  // namespace dmoscope
