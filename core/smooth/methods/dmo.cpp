#include "core/smooth/methods/dmo.h"

#include "core/smooth/methods/grid.h"
#include "core/smooth/methods/lane_dmo.h"
#include "core/smooth/methods/star_kernels.h"

namespace dmoscope {

namespace {

template <class Frame>
Visit<Frame, Grid> grid_visit(const SmoothingTask& task, const CompositeObjective& objective) {
  if constexpr (std::is_same_v<Frame, Curved>)
    return {task, objective, Grid(task, objective)};
  else
    return {task, objective, Grid(task, objective), star_kernel<Frame>(task, objective)};
}

/// Makes lanes for the many vertices of a planar mesh; null where there is no kernel for the objective.
std::unique_ptr<Smoother> make_lanes(const SmoothingTask& task, const CompositeObjective& objective) {
  if (!objective.is_single() || task.search.precision != Precision::Float) return nullptr;
  if (is_built_in(objective.first))
    return std::make_unique<LaneDmo>(task, grid_visit<Plane>(task, objective), kernels(task.search).lanes(objective.first));
  const InputMesh& input = *task.input;
  if (!has_target_kernel(input, objective.first, task.search)) return nullptr;
  const auto judge = input.quality_context().judge(objective.first);
  const TargetTable& targets = judge->targets();
  const bool crossed = has_crossed_targets(targets, static_cast<Index>(input.mesh.elements.size()));
  return std::make_unique<LaneDmo>(
      task, grid_visit<Plane>(task, objective), kernels(task.search).target_lanes(crossed),
      [&](const StarTable& table) { return build_star_targets(targets, crossed, input.mesh, input.topology, table, task.pool); });
}

}  // namespace

std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task, const CompositeObjective& objective) {
  if (task.input->is_surface()) return make_rule_smoother(task, grid_visit<Curved>(task, objective));
  if (task.input->is_volume()) return make_rule_smoother(task, grid_visit<Space>(task, objective));
  if (auto lanes = make_lanes(task, objective)) return lanes;
  return make_rule_smoother(task, grid_visit<Plane>(task, objective));
}

std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task) { return make_dmo_smoother(task, objective_of(task)); }

template <class Frame>
std::optional<Vec3> watch_visit(const SmoothingTask& task, const CompositeObjective& objective, const Sweep& sweep, PositionView positions,
                                Index vertex, VisitWatcher& watcher, const std::optional<Vec3>& by_lanes) {
  SmoothingTask alone = task;
  alone.colouring = std::make_shared<const Colouring>(Colouring{{vertex}, {0, 1}});
  Visit<Frame, Grid> visit = grid_visit<Frame>(alone, objective);
  visit.begin(sweep);
  typename Visit<Frame, Grid>::Scratch scratch;
  scratch.room.watcher = &watcher;
  return by_lanes ? visit.confirmed(vertex, *by_lanes, positions, scratch) : visit.target(positions, vertex, scratch);
}
template std::optional<Vec3> watch_visit<Plane>(const SmoothingTask&, const CompositeObjective&, const Sweep&, PositionView, Index,
                                                VisitWatcher&, const std::optional<Vec3>&);
template std::optional<Vec3> watch_visit<Space>(const SmoothingTask&, const CompositeObjective&, const Sweep&, PositionView, Index,
                                                VisitWatcher&, const std::optional<Vec3>&);
template std::optional<Vec3> watch_visit<Curved>(const SmoothingTask&, const CompositeObjective&, const Sweep&, PositionView, Index,
                                                 VisitWatcher&, const std::optional<Vec3>&);

}  // namespace dmoscope
