#include "core/smooth/methods/two_aims_comparison.h"

#include "core/smooth/kernels/compiled/kernel_set.h"

namespace dmoscope {

namespace {

/// The least metric; 0 where the star is not certain to be sound.
BeforeAndAfter least(Metric metric, const VolumeKernel& kernel, const VolumeComparison& task) {
  const BeforeAndAfter rank = kernel.least_ranks(task);
  if (!(rank.before > kLeastCertain) || !(rank.after > kLeastCertain)) return {};
  return {metric_of_rank(metric, rank.before), metric_of_rank(metric, rank.after)};
}

}  // namespace

TwoAimsComparison::TwoAimsComparison(SimdLevel level, Metric first, const Aims& aims)
    : first_(first), aims_(aims), first_kernel_(kernels(level).volume(first)), second_kernel_(kernels(level).volume(aims.metric)) {}

std::optional<bool> TwoAimsComparison::gains(const IndexedStar& star, const StarPoints<Space>& points, Vec3 from, Vec3 target) const {
  if (!has_metric(star, first_)) return std::nullopt;
  const VolumeComparison task{star, points.at.data(), from, target};
  return gains_for_certain(aims_.threshold, least(first_, first_kernel_, task), [&]() -> BeforeAndAfter {
    if (aims_.raise_mean()) return first_kernel_.means(task, aims_.mean);
    return has_metric(star, aims_.metric) ? least(aims_.metric, second_kernel_, task) : BeforeAndAfter{};
  });
}

}  // namespace dmoscope
