#pragma once
// Raises the least quality of a set of atoms by moving all their free vertices together: minimises tau subject to f <= tau for every
// atom's f, by a primal-dual interior point (Nocedal and Wright 2006, chapter 19). Other atoms may have limits of their own instead of tau.
// If every atom has a limit, the sum of all f is minimised instead.

#include <functional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/joint/atoms.h"
#include "core/joint/joint_ways.h"

namespace dmoscope {

/// Problem with vertices numbered for itself: first those that may move. Unknown are their displacements from `places`.
template <int D>
struct JointProblem {
  std::size_t free_vertices = 0;
  std::vector<std::array<double, D>> places;  // rough positions of all vertices; of the free ones only differences matter
  std::vector<Atom<D>> atoms;                 // each has a free vertex; `element` is that of the mesh
  std::vector<AtomEdges<D>> edges;            // edges of each atom, undisplaced; about as long as 1
  std::vector<double> references;             // one an atom where AtomFunction reads them; else empty
  JointWays<D>* path = nullptr;               // ways of the sliding vertices; null: all may go anywhere
  std::vector<double> limits{};               // limits of the last atoms: their f stay below these, which they are at the begin
  const AtomFunction<D>* limited = nullptr;   // function f of atoms with limits; null where there are none
  std::size_t beside = 0;  // where all have limits: number of the last atoms that belong to `limited`, and not to the sum
  /// Number of atoms that are raised; 0: the sum of all f falls instead, without guards (kGuardPiece).
  [[nodiscard]] std::size_t raised() const { return atoms.size() - limits.size(); }
  /// Bound below which an atom's f must stay.
  [[nodiscard]] double bound(std::size_t atom, double tau) const { return atom < raised() ? tau : limits[atom - raised()]; }
  [[nodiscard]] double reference(std::size_t atom) const { return references.empty() ? 1.0 : references[atom]; }
};

/// Edges of an atom with the free vertices displaced.
template <int D>
[[nodiscard]] AtomEdges<D> displaced_edges(const JointProblem<D>& problem, std::size_t atom,
                                           const std::vector<std::array<double, D>>& displacements) {
  const auto& vertices = problem.atoms[atom].vertices;
  const auto displacement = [&](Index v) { return v < problem.free_vertices ? displacements[v] : std::array<double, D>{}; };
  AtomEdges<D> result = problem.edges[atom];
  const auto first = displacement(vertices[0]);
  for (std::size_t j = 0; j < result.size(); ++j) {
    const auto other = displacement(vertices[j + 1]);
    for (std::size_t r = 0; r < other.size(); ++r) result[j][r] += other[r] - first[r];
  }
  return result;
}

struct InteriorPointOptions {
  double gap = 2e-4;           // relative: ends when tau (or the sum) may be that far above the least possible
  double early_gap = 0.0;      // gap on the way there at which `leave_early` is asked
  double enough = -1.0;        // ends when all f are at most this
  int max_steps = 150;         // Newton steps
  ThreadPool* pool = nullptr;  // null: the calling thread alone
};

enum class InteriorPointEnd { Gap, LeftEarly, Enough, Steps, Stuck, NotSound };

/// State after a Newton step, and at the end.
template <int D>
struct JointIterate {
  std::vector<std::array<double, D>> displacements;  // displacements of the free vertices
  std::vector<double> values;                        // f of each atom
  std::vector<double> multipliers;                   // multipliers of the atoms, > 0; the sum over the raised ones is about 1
  double worst = 0.0;                                // greatest f of the raised atoms; or the sum, over that at the start
  double tau = 0.0, mu = 0.0;                        // f < tau; multiplier * (tau - f) is about mu
  int steps = 0;                                     // Newton steps so far
  /// Distance at most of tau from the least possible, by duality; for convex f a bound, else an estimate.
  [[nodiscard]] double gap() const { return mu * static_cast<double>(values.size()); }
};

template <int D>
struct JointSolution {
  JointIterate<D> last;                     // its multipliers are the final ones
  std::vector<std::array<double, D>> best;  // the displacements with the least `worst`; all 0 where nothing is better than that
  double best_worst = 0.0, start_worst = 0.0;
  InteriorPointEnd end = InteriorPointEnd::NotSound;  // NotSound: an f was infinite at the start; nothing was done
};

template <int D>
struct JointCallbacks {
  std::function<void(const JointIterate<D>&)> step{};         // after every Newton step
  std::function<bool(const JointIterate<D>&)> leave_early{};  // see early_gap; asked once
};

/// Solves the problem. Throws Cancelled within one Newton step of Progress::request_cancel(). Every sum has a fixed order: the same bits
/// everywhere, for any pool.
template <int D>
[[nodiscard]] JointSolution<D> solve_joint(const JointProblem<D>& problem, const AtomFunction<D>& function,
                                           const InteriorPointOptions& options, const JointCallbacks<D>& callbacks, Progress& progress);

}  // namespace dmoscope
