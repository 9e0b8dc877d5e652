#include "core/smooth/methods/composite_star_kernel.h"

#include "core/smooth/kernels/compiled/kernel_set.h"

namespace dmoscope {

namespace {

/// Returns whether the metric's sign tells that a quadrilateral is inverted.
bool sees_inversion(Metric metric) {
  return formulas::with_planar_metric(metric, []<Metric M>() { return formulas::Formula<M>::kSeesInversion; });
}

/// Least metric; 0 where the star is not certain to be sound.
BeforeAndAfter least(Metric metric, const VolumeKernel& kernel, const VolumeComparison& task) {
  const BeforeAndAfter rank = kernel.least_ranks(task);
  if (!(rank.before > kLeastCertain) || !(rank.after > kLeastCertain)) return {};
  return {metric_of_rank(metric, rank.before), metric_of_rank(metric, rank.after)};
}

}  // namespace

CompositeComparison::CompositeComparison(SimdLevel level, Metric first, const PlainComposite& aims)
    : first_(first), aims_(aims), first_kernel_(kernels(level).volume(first)), second_kernel_(kernels(level).volume(aims.metric)) {}

std::optional<bool> CompositeComparison::gains(const IndexedStar& star, const StarPoints<Space>& points, Vec3 from, Vec3 target) const {
  if (!has_metric(star, first_)) return std::nullopt;
  const VolumeComparison task{star, points.at.data(), from, target};
  return gains_for_certain(aims_.threshold, least(first_, first_kernel_, task), [&]() -> BeforeAndAfter {
    if (aims_.raise_mean()) return first_kernel_.means(task, aims_.mean);
    return has_metric(star, aims_.metric) ? least(aims_.metric, second_kernel_, task) : BeforeAndAfter{};
  });
}

template <class Frame>
CompositeStarKernel<Frame>::CompositeStarKernel(const SmoothingTask& task, const CompositeObjective& objective)
    : judge_(*task.input, objective),
      aims_(search_for<Frame>(objective, task.search)),
      kernel_(kernels(task.search).in<Frame>().composite(objective.first)),
      stars_(*task.input, *task.colouring, task.pool) {
  if constexpr (std::is_same_v<Frame, Space>)
    comparison_.emplace(task.search.simd.value_or(best_simd_level()), objective.first, *plain_composite(objective));
}

template <class Frame>
typename CompositeStarKernel<Frame>::Room& CompositeStarKernel<Frame>::room() {
  thread_local Room room;  // kept: a visit allocates nothing
  return room;
}

template <class Frame>
CompositeFound<Frame> CompositeStarKernel<Frame>::search(const Star& star, PositionView positions, Index vertex, int levels) const {
  CompositeSearch<Frame> task = aims_;
  task.box = star.box;
  task.levels = levels;
  take_star(task, judge_.composite(), star, judge_.density_of(star, positions, vertex));
  return kernel_(task);
}

template <class Frame>
typename CompositeStarKernel<Frame>::Found CompositeStarKernel<Frame>::find(PositionView positions, Index vertex,
                                                                            const Untangling& /*untangling*/, int levels) const {
  const IndexedStars::Star star = stars_.of(vertex);
  if (!star.fits) return {};
  Room& room = this->room();
  gather_points(judge_.mesh().frame, star, positions, vertex, room.points);
  fill_star(star, room.points, room.star);
  const CompositeFound<Frame> found = search(room.star, positions, vertex, levels);
  return {found.ready, found.offset, room.star.scale, room.star.box};
}

/// Compares the two places by the star as it was searched.
template <class Frame>
std::optional<bool> CompositeStarKernel<Frame>::gains(PositionView positions, Index vertex, Vec3 target) const {
  const Vec3 from = positions[vertex];
  if constexpr (std::is_same_v<Frame, Space>) {
    return comparison_->gains(stars_.of(vertex).elements, room().points, from, target);
  } else {
    const CompositeObjective& composite = judge_.composite();
    const Metric* second = std::get_if<Metric>(&composite.second);
    const Star& searched = room().star;
    // Leaves soundness of corners to the statistics' formulas where the metric does not tell it, and densities, too.
    if ((!searched.quadrilaterals.empty() && !sees_inversion(composite.first)) || (second == nullptr && !composite.raise_mean()))
      return std::nullopt;
    const JudgedStarView<Frame> star(searched);
    const Offset step = times(judge_.mesh().frame.offset(target, from), 1.0 / searched.scale);
    const MetricFunctions<Frame>& first = metric_functions<Frame>(composite.first);
    const BeforeAndAfter least{first.least_at(star, Offset{}, 0.0), first.least_at(star, step, 0.0)};
    return gains_for_certain(composite.threshold, least, [&]() -> BeforeAndAfter {
      if (second == nullptr) return {first.mean_at(star, Offset{}, aims_.mean), first.mean_at(star, step, aims_.mean)};
      const auto rank_at = metric_functions<Frame>(*second).least_rank_at;
      return {rank_at(star, Offset{}), rank_at(star, step)};
    });
  }
}

template <class Frame>
bool CompositeStarKernel<Frame>::valid_at(Index vertex, Vec3 target) const {
  if constexpr (std::is_same_v<Frame, Space>)
    return comparison_->valid_at(stars_.of(vertex).elements, room().points, target);
  else
    return false;
}

template class CompositeStarKernel<Plane>;
template class CompositeStarKernel<Space>;

}  // namespace dmoscope
