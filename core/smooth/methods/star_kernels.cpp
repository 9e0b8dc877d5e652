#include "core/smooth/methods/star_kernels.h"

#include <algorithm>
#include <utility>

#include "core/smooth/defined_state.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/composite_star_kernel.h"
#include "core/smooth/methods/defined_search.h"
#include "core/smooth/methods/target_composite_kernel.h"
#include "core/smooth/methods/volume_star_search.h"

namespace dmoscope {

namespace {

/// Kernel for a metric that is defined by a formula or a target, for sound stars.
template <class Frame>
class DefinedKernel final : public StarKernel<Frame> {
 public:
  using typename StarKernel<Frame>::Found;
  DefinedKernel(const SmoothingTask& task, Metric metric)
      : judge_(task.input->quality_context().judge(metric)),
        star_judge_(defined_star_judge<Frame>(*task.input, *judge_)),
        search_(star_judge_, task.search) {}

  [[nodiscard]] Found find(PositionView positions, Index vertex, const Untangling& /*untangling*/, int levels) const override {
    thread_local typename DefinedSearch<Frame>::Scratch scratch;  // kept: a visit allocates nothing
    const StarState before = defined_star_state(star_judge_, positions, vertex, positions[vertex]);
    if (!(before.jacobian > 0.0)) return {};
    const auto found = search_.find(positions, vertex, levels, scratch);
    return {true, found.offset, found.scale, found.box, !search_.in_double(), before};
  }

 private:
  std::shared_ptr<const DefinedJudge> judge_;
  DefinedStarJudge<Frame> star_judge_;
  DefinedSearch<Frame> search_;
};

VolumeStarSearch::Points& points() {
  thread_local VolumeStarSearch::Points points;  // kept: a visit allocates nothing
  return points;
}
typename StarKernel<Space>::Found found_by(const VolumeFound& found) {
  return {found.ready, point_of<double>(found.offset), points().scale, point_of<double>(points().narrow_box), true};
}

/// Kernel for a built-in metric, for stars that the search can handle: not with inverted or nearly inverted elements, nor too many. Against
/// targets for the mean ratio, for stars of tetrahedra; all others by the kernel for formulas.
class FastVolumeKernel final : public StarKernel<Space> {
 public:
  FastVolumeKernel(const SmoothingTask& task, Metric metric) : FastVolumeKernel(task, VolumeStarSearch(metric, task.search)) {}
  FastVolumeKernel(const SmoothingTask& task, Metric metric, TetrahedronTargets targets)
      : FastVolumeKernel(task, VolumeStarSearch(task.search, targets.crossed())) {
    targets_ = std::move(targets);
    others_.emplace(task, metric);
  }

  [[nodiscard]] Found find(PositionView positions, Index vertex, const Untangling& untangling, int levels) const override {
    const bool fits = targets_ ? targets_->fit(mesh_.star(vertex))
                               : !(has_inside_ && untangling.looks_inside() && has_inverted(mesh_, positions, vertex));
    VolumeFound found{};
    if (fits) found = search_.find(stars_.of(vertex), positions, vertex, levels, points(), targets_of(vertex));
    found_here() = found.ready;
    return found.ready || !others_ ? found_by(found) : others_->find(positions, vertex, untangling, levels);
  }
  [[nodiscard]] std::optional<bool> gains(PositionView positions, Index vertex, Vec3 target) const override {
    if (!found_here()) return std::nullopt;
    return search_.gains(stars_.of(vertex), points(), positions[vertex], target, targets_of(vertex));
  }
  [[nodiscard]] bool valid_at(Index vertex, Vec3 target) const override {
    return targets_ ? found_here() : search_.valid_at(stars_.of(vertex), points(), target);  // tetrahedra have no inside
  }
  [[nodiscard]] bool keeps(const Guard& guard, Index vertex, Vec3 target) const override {
    return found_here() && search_.keeps(guard, stars_.of(vertex), points(), target);
  }
  [[nodiscard]] std::span<const Index> others(Index vertex) const override { return stars_.of(vertex).vertices; }

 private:
  FastVolumeKernel(const SmoothingTask& task, VolumeStarSearch search)
      : mesh_(task.input->view<Space>()),
        search_(std::move(search)),
        has_inside_(std::ranges::any_of(task.input->mesh.elements.kinds(), &has_inside)),
        stars_(*task.input, *task.colouring, task.pool) {}

  /// Returns whether this thread's last winner is that of the fast search.
  static bool& found_here() {
    thread_local bool found = false;
    return found;
  }
  [[nodiscard]] VolumeTargets targets_of(Index vertex) const {
    return targets_ ? VolumeTargets{mesh_.star(vertex).data(), targets_->numbers()} : VolumeTargets{};
  }

  MeshView<Space> mesh_;
  VolumeStarSearch search_;
  bool has_inside_;
  IndexedStars stars_;
  std::optional<TetrahedronTargets> targets_;   // none: ideal ones
  std::optional<DefinedKernel<Space>> others_;  // against targets
};

}  // namespace

bool has_target_kernel(const InputMesh& input, Metric metric, const SearchParameters& parameters) {
  if (input.is_surface() || is_built_in(metric)) return false;
  const DefinedMetric& of = defined(metric);
  return of.base == Metric::MeanRatio && !of.target.is_ideal() && parameters.precision == Precision::Float &&
         (input.is_volume() || parameters.grid_points == 8);
}

template <class Frame>
std::shared_ptr<const StarKernel<Frame>> star_kernel(const SmoothingTask& task, const CompositeObjective& objective) {
  const bool fast = task.search.precision != Precision::Double;
  if (!objective.is_single()) {
    if (TargetCompositeKernel<Frame>::is_for(task, objective)) return std::make_shared<const TargetCompositeKernel<Frame>>(task, objective);
    if (!fast || !is_for_kernels(objective)) return nullptr;
    return std::make_shared<const CompositeStarKernel<Frame>>(task, objective);
  }
  if (is_built_in(objective.first)) {
    if constexpr (std::is_same_v<Frame, Space>)
      if (fast) return std::make_shared<const FastVolumeKernel>(task, objective.first);
    return nullptr;
  }
  if constexpr (std::is_same_v<Frame, Space>) {
    if (has_target_kernel(*task.input, objective.first, task.search)) {
      TetrahedronTargets targets(task.input->quality_context().judge(objective.first)->targets(), task.input->mesh);
      if (targets.any()) return std::make_shared<const FastVolumeKernel>(task, objective.first, std::move(targets));
    }
  }
  return std::make_shared<const DefinedKernel<Frame>>(task, objective.first);
}

template std::shared_ptr<const StarKernel<Plane>> star_kernel<Plane>(const SmoothingTask&, const CompositeObjective&);
template std::shared_ptr<const StarKernel<Space>> star_kernel<Space>(const SmoothingTask&, const CompositeObjective&);

}  // namespace dmoscope
