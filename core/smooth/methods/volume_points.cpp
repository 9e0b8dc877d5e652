#include "core/smooth/methods/volume_points.h"

#include <algorithm>
#include <cmath>

#include "core/search/mesh_star.h"

namespace dmoscope {

void gather_points(const IndexedStars::Star& star, PositionView positions, Index vertex, VolumePoints& points) {
  const std::size_t count = star.vertices.size();
  if (points.at.size() < count) {
    points.at.resize(count);
    points.offsets.resize(count);
  }
  const Vec3 origin = positions[vertex];
  StarBox<Vec3> box;
  for (std::size_t i = 0; i < count; ++i) {
    points.at[i] = positions[star.vertices[i]];
    points.offsets[i] = points.at[i] - origin;
    box.add(points.offsets[i]);
  }
  points.scale = star_scale<Space>(box.largest());
  const double inverse = 1.0 / points.scale;
  const auto scaled = [inverse](Vec3 p) { return Vec3{p.x * inverse, p.y * inverse, p.z * inverse}; };
  for (std::size_t i = 0; i < count; ++i) points.offsets[i] = scaled(points.offsets[i]);
  points.box = scaled(box.size());
}

bool has_metric(const IndexedStar& star, Metric metric) {
  const bool for_corners = formulas::with_volume_metric(metric, []<Metric M>() { return formulas::kDefinedForCorners<M>; });
  return for_corners || std::all_of(star.counts + 1, star.counts + kStarKinds, [](std::uint8_t count) { return count == 0; });
}

double metric_of_rank(Metric metric, double rank) {
  if (metric == Metric::MeanRatio) return std::cbrt(rank);
  if (metric == Metric::MinAngle) return 2.0 * std::atan(rank) / formulas::SolidFormula<Metric::MinAngle>::kRegular;
  return rank;
}

}  // namespace dmoscope
