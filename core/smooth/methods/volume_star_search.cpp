#include "core/smooth/methods/volume_star_search.h"

#include <algorithm>

namespace dmoscope {

namespace {
Vec3Of<float> narrow(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }
}  // namespace

VolumeFound VolumeStarSearch::find(const IndexedStars::Star& star, PositionView positions, Index vertex, int levels, Points& points,
                                   const VolumeTargets& targets) const {
  if (!star.fits) return {};
  gather_points(Space{}, star, positions, vertex, points);
  if (points.narrow.size() < points.offsets.size()) points.narrow.resize(points.offsets.size());
  for (std::size_t i = 0; i < star.vertices.size(); ++i) points.narrow[i] = narrow(points.offsets[i]);
  points.narrow_box = narrow(points.box);
  return kernel_.search(
      {star.elements, points.narrow.data(), points.narrow_box, parameters_.grid_points, levels, parameters_.omega, targets});
}

std::optional<bool> VolumeStarSearch::gains(const IndexedStars::Star& star, const Points& points, Vec3 from, Vec3 target,
                                            const VolumeTargets& targets) const {
  if (!has_metric(star.elements, metric_)) return std::nullopt;
  const BeforeAndAfter rank = kernel_.least_ranks({star.elements, points.at.data(), from, target, targets});
  if (!(rank.before > kLeastCertain)) return std::nullopt;
  const Certainty rises = compare(rank.after, rank.before);
  return rises == Certainty::Unsure ? std::nullopt : std::optional(rises == Certainty::Greater);
}

bool VolumeStarSearch::keeps(const Guard& guard, const IndexedStars::Star& star, const Points& points, Vec3 target) const {
  if (guard.metric != kGuard) return false;
  const double after = guard_kernel_.least_ranks({star.elements, points.at.data(), target, target}).after;
  const double floor = std::max(guard.floor * guard.floor * guard.floor, kLeastCertain);  // the rank in volumes is the cube
  return compare(after, floor) == Certainty::Greater;
}

}  // namespace dmoscope
