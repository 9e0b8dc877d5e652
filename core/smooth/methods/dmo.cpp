#include "core/smooth/methods/dmo.h"

#include <optional>

#include "core/smooth/methods/defined_dmo.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/fast_volume_search.h"
#include "core/smooth/methods/lane_dmo.h"

namespace dmoscope {

namespace {

/// The plain search in double.
template <Metric M, class Frame>
class Reference {
 public:
  using Scratch = StarIn<Frame, double>;
  static constexpr std::size_t kGrain = std::is_same_v<Frame, Plane> ? 32 : 1;
  explicit Reference(const SmoothingTask& task) : mesh_(*task.input), parameters_(task.search) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const OffsetIn<Frame, double> found = search_star<M>(StarViewIn<Frame, double>(star), star.box, parameters_, mesh_.untangling);
    if (found == OffsetIn<Frame, double>{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  bool gains(Index vertex, Vec3 target, PositionView positions) const {
    return gains_at<M>(mesh_.view, positions, vertex, target, mesh_.untangling);
  }

 private:
  RuleMesh<Frame> mesh_;
  SearchParameters parameters_;
};

}  // namespace

StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex) {
  if (!is_built_in(metric)) {
    const auto judge = input.quality_context().judge(metric);
    const auto state = [&]<class Frame>() {
      return defined_star_state(defined_star_judge<Frame>(input, *judge), positions, vertex, positions[vertex]);
    };
    return input.is_surface() ? state.template operator()<Curved>() : with_frame(input, state);
  }
  if (input.is_surface()) return metric_functions<Curved>(metric).state(input.view<Curved>(), positions, vertex, positions[vertex]);
  return with_metric_and_frame(
      input, metric, [&]<Metric M, class Frame>() { return star_state<M>(input.view<Frame>(), positions, vertex, positions[vertex]); });
}

std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task) {
  if (task.input->is_surface()) return make_surface_smoother(task, single_objective(task.metric));
  if (!is_built_in(task.metric)) return make_defined_dmo_smoother(task);
  return with_metric_and_frame(*task.input, task.metric, [&]<Metric M, class Frame>() -> std::unique_ptr<Smoother> {
    if (task.search.precision == Precision::Float) {
      if constexpr (std::is_same_v<Frame, Plane>)
        return std::make_unique<LaneDmo<Reference<M, Frame>>>(task, Reference<M, Frame>(task), lane_kernel(simd_level(task), M));
      else
        return make_sliding_smoother<Space>(task, FastVolumeSearch<M>(task), single_objective(M));
    }
    return make_sliding_smoother<Frame>(task, Reference<M, Frame>(task), single_objective(M));
  });
}

}  // namespace dmoscope
