#include "core/smooth/methods/volume_two_aims.h"

namespace dmoscope {

VolumeTwoAims::VolumeTwoAims(const SmoothingTask& task, Metric first, const Aims& aims)
    : stars_(task.input->mesh, task.input->topology, *task.colouring, task.pool), first_(first), aims_(aims) {
  const SimdLevel level = task.search.simd.value_or(best_simd_level());
  first_kernel_ = volume_kernel(level, first);
  second_kernel_ = volume_kernel(level, aims.metric);
}

bool VolumeTwoAims::gather(PositionView positions, Index vertex, VolumePoints& points, VolumeStar<double>& star) const {
  const IndexedStars::Star indexed = stars_.of(vertex);
  if (!indexed.fits || !has_metric(indexed.elements, first_)) return false;
  gather_points(indexed, positions, vertex, points);
  const std::uint16_t* corner = indexed.elements.corners;
  const auto next = [&] { return points.offsets[*corner++]; };
  std::size_t kind = 0;
  star.for_each_list([&]<class Element>(std::vector<Element>& list) {
    list.resize(indexed.elements.counts[kind++]);
    for (Element& element : list) {
      if constexpr (requires { element.others; }) {
        for (Vec3& other : element.others) other = next();
      } else if constexpr (requires { element.base; }) {
        for (Vec3& other : element.base) other = next();
      } else {
        for (Vec3* other : {&element.b, &element.c, &element.d}) *other = next();
      }
    }
  });
  star.box = points.box;
  star.scale = points.scale;
  return true;
}

/// The least metric; 0 of a star that is not certain to be sound.
BeforeAndAfter VolumeTwoAims::least(Metric metric, const VolumeKernel& kernel, const VolumeComparison& task) const {
  const BeforeAndAfter rank = kernel.least_ranks(task);
  if (!(rank.before > kLeastCertain) || !(rank.after > kLeastCertain)) return {};
  return {metric_of_rank(metric, rank.before), metric_of_rank(metric, rank.after)};
}

std::optional<bool> VolumeTwoAims::gains(Index vertex, const VolumePoints& points, Vec3 from, Vec3 target) const {
  const IndexedStars::Star star = stars_.of(vertex);
  const VolumeComparison task{star.elements, points.at.data(), from, target};
  const auto known = [](Certainty certainty) {
    return certainty == Certainty::Unsure ? std::nullopt : std::optional(certainty == Certainty::Greater);
  };
  const BeforeAndAfter first = least(first_, first_kernel_, task);
  if (!(first.before > 0.0)) return std::nullopt;
  const Certainty before_beyond = compare(first.before, aims_.threshold), after_beyond = compare(first.after, aims_.threshold);
  if (before_beyond == Certainty::Unsure) return std::nullopt;
  if (before_beyond == Certainty::Less) return known(compare(first.after, first.before));
  if (after_beyond != Certainty::Greater) return known(after_beyond);
  if (aims_.raise_mean()) {
    const BeforeAndAfter mean = first_kernel_.means(task);
    return known(compare(mean.after, mean.before));
  }
  if (!has_metric(star.elements, aims_.metric)) return std::nullopt;
  const BeforeAndAfter second = least(aims_.metric, second_kernel_, task);
  return second.before > 0.0 ? known(compare(second.after, second.before)) : std::nullopt;
}

}  // namespace dmoscope
