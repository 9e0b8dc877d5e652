#include "core/smooth/methods/defined_dmo.h"

#include <utility>

#include "core/search/grid_search.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/defined_search.h"
#include "core/smooth/methods/fast_volume_search.h"
#include "core/smooth/methods/lane_dmo.h"

namespace dmoscope {

namespace {

/// One vertex's visit: a rule for RuleSmoother.
template <class Frame>
class DefinedDmo {
 public:
  using Scratch = typename DefinedSearch<Frame>::Scratch;
  static constexpr std::size_t kGrain = std::is_same_v<Frame, Plane> ? 64 : 8;

  explicit DefinedDmo(const SmoothingTask& task)
      : mesh_(*task.input, task.metric), parameters_(task.search), search_(mesh_.star_judge(), task.search) {}

  void begin(const Sweep& sweep) { mesh_.begin(sweep); }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    if (mesh_.untangling().repair && !is_tangled(positions, vertex)) return std::nullopt;
    const StarState before = mesh_.state(positions, vertex, positions[vertex]);
    const bool tangled = !(before.jacobian > 0.0);
    const Offset found = tangled ? search_tangled(positions, vertex) : search_sound(positions, vertex, scratch);
    if (found == Offset{}) return std::nullopt;
    return mesh_.moved_if_gaining(positions, vertex, found, before);
  }
  bool gains(Index vertex, Vec3 target, PositionView positions) const {
    return defined_confirm_at(mesh_.star_judge(), positions, vertex, target, mesh_.untangling()) == Confirmation::Gains;
  }

 private:
  using Offset = OffsetIn<Frame, double>;  // in mesh units

  /// By the Jacobians alone: a repair asks all vertices, and moves few.
  [[nodiscard]] bool is_tangled(PositionView positions, Index vertex) const {
    const auto no_metric = [](const Incidence& /*at*/, const auto& /*shape*/) { return 0.0; };
    return !(star_state_by(mesh_.mesh().view, positions, vertex, positions[vertex], no_metric).jacobian > 0.0);
  }
  [[nodiscard]] Offset search_sound(PositionView positions, Index vertex, Scratch& scratch) const {
    const auto found = search_.find(positions, vertex, parameters_.levels, scratch);
    return times(found.offset, found.scale);
  }
  [[nodiscard]] Offset search_tangled(PositionView positions, Index vertex) const {
    const DefinedStar<Frame> star(mesh_.star_judge(), positions, vertex);
    typename DefinedStar<Frame>::Levels levels(star);
    return times(search_star<kDefinedMetric>(star.view(), star.star().box, parameters_, mesh_.untangling(), Solo{}, levels), star.scale());
  }

  DefinedRuleMesh<Frame> mesh_;
  SearchParameters parameters_;
  DefinedSearch<Frame> search_;
};

/// For speed: stars of tetrahedra by target_volume_kernel(), all others by the rule for them.
class TargetVolumeDmo {
 public:
  struct Scratch {
    VolumeStarSearch::Points points;
    DefinedDmo<Space>::Scratch alone;
  };
  static constexpr std::size_t kGrain = 8;
  TargetVolumeDmo(const SmoothingTask& task, std::shared_ptr<const TetrahedronTargets> targets)
      : alone_(task),
        mesh_(*task.input),
        targets_(std::move(targets)),
        search_(task.search, targets_->crossed()),
        levels_(task.search.levels),
        stars_(std::make_shared<const IndexedStars>(*task.input, *task.colouring, task.pool)) {}

  void begin(const Sweep& sweep) {
    alone_.begin(sweep);
    mesh_.untangling = sweep.untangling;
  }
  [[nodiscard]] std::span<const Index> others(Index vertex) const { return stars_->of(vertex).vertices; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const auto incidences = mesh_.view.star(vertex);
    const VolumeTargets targets{incidences.data(), targets_->numbers()};
    const IndexedStars::Star star = stars_->of(vertex);
    VolumeFound found;
    if (!mesh_.untangling.repair && targets_->fit(incidences))
      found = search_.find(star, positions, vertex, levels_, scratch.points, targets);
    if (!found.ready) return alone_.target(positions, vertex, scratch.alone);
    const Vec3 offset{found.offset.x, found.offset.y, found.offset.z};
    if (offset == Vec3{}) return std::nullopt;
    const std::optional<Vec3> target = mesh_.moved(positions[vertex], times(offset, scratch.points.scale));
    if (!target) return std::nullopt;
    const std::optional<bool> known = search_.gains(star, scratch.points, positions[vertex], *target, targets);
    return known.value_or(false) || (!known && alone_.gains(vertex, *target, positions)) ? target : std::nullopt;
  }

 private:
  DefinedDmo<Space> alone_;
  RuleMesh<Space> mesh_;
  std::shared_ptr<const TetrahedronTargets> targets_;  // shared: the rule is moved about
  VolumeStarSearch search_;
  int levels_;
  std::shared_ptr<const IndexedStars> stars_;
};

}  // namespace

bool has_target_kernel(const InputMesh& input, Metric metric, const SearchParameters& parameters) {
  if (input.is_surface() || is_built_in(metric)) return false;
  const DefinedMetric& of = defined(metric);
  return of.base == Metric::MeanRatio && !of.target.is_ideal() && parameters.precision == Precision::Float &&
         (input.is_volume() || parameters.grid_points == 8);
}

std::unique_ptr<Smoother> make_defined_dmo_smoother(const SmoothingTask& task) {
  const InputMesh& input = *task.input;
  if (has_target_kernel(input, task.metric, task.search)) {
    const auto judge = input.quality_context().judge(task.metric);
    const TargetTable& targets = judge->targets();
    if (!input.is_volume()) {
      const bool crossed = has_crossed_targets(targets, static_cast<Index>(input.mesh.elements.size()));
      return std::make_unique<LaneDmo<DefinedDmo<Plane>>>(
          task, DefinedDmo<Plane>(task), target_lane_kernel(simd_level(task), crossed),
          [&](const StarTable& table) { return build_star_targets(targets, crossed, input.mesh, input.topology, table, task.pool); });
    }
    auto tetrahedra = std::make_shared<const TetrahedronTargets>(targets, input.mesh);
    if (tetrahedra->any())
      return make_sliding_smoother<Space>(task, TargetVolumeDmo(task, std::move(tetrahedra)), single_objective(task.metric));
  }
  return with_frame(
      input, [&]<class Frame>() { return make_sliding_smoother<Frame>(task, DefinedDmo<Frame>(task), single_objective(task.metric)); });
}

}  // namespace dmoscope
