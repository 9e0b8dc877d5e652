#pragma once
// DMO on the CPU (paper, Algorithm 1): the grid search for each vertex, confirmed in double before the vertex moves.

#include <memory>

#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/visit_watcher.h"

namespace dmoscope {

/// Makes the smoother. See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task);
/// Makes the smoother for another objective than the task's.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task, const CompositeObjective& objective);

/// Visits one vertex as that smoother does, but for lanes, and tells a watcher of its search. `by_lanes`: the place that lanes have found,
/// which it confirms. Returns the place to which the vertex goes; none: it stays. The task's colouring is not read. Frame: Plane, Space or
/// Curved.
template <class Frame>
[[nodiscard]] std::optional<Vec3> watch_visit(const SmoothingTask& task, const CompositeObjective& objective, const Sweep& sweep,
                                              PositionView positions, Index vertex, VisitWatcher& watcher,
                                              const std::optional<Vec3>& by_lanes = {});

}  // namespace dmoscope
