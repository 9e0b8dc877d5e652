#pragma once
// The places of a star's vertices, for the fast searches of volumes, and comparisons of two places by the kernels.

#include <vector>

#include "core/mesh/position_view.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope {

/// The places of a star's other vertices.
struct VolumePoints {
  std::vector<Vec3> at;         // positions
  std::vector<Vec3> offsets;    // from the vertex, in units of scale: see MeshStar
  Vec3 box;                     // of the offsets
  double scale = 1.0;
  std::vector<Vec3Of<float>> narrow;  // the offsets
  Vec3Of<float> narrow_box;
};
/// Fills all but the narrow ones; its vectors are kept.
void gather_points(const IndexedStars::Star& star, PositionView positions, Index vertex, VolumePoints& points);

/// Is one value of a metric, a rank or a mean greater than another, both found in double by the search's formulas?
enum class Certainty { Greater, Less, Unsure };
/// Unsure where rounding may decide: the statistics' formulas have to. Values from kLeastCertain on.
[[nodiscard]] inline Certainty compare(double a, double b) {
  constexpr double kDoubt = 1e-8;  // far more than rounding
  if (a > b * (1.0 + kDoubt)) return Certainty::Greater;
  return a < b * (1.0 - kDoubt) ? Certainty::Less : Certainty::Unsure;
}
inline constexpr double kLeastCertain = 1e-4;

/// Do all elements of the star have the metric, so that the kernels judge all of it?
[[nodiscard]] bool has_metric(const IndexedStar& star, Metric metric);
/// The metric of an element whose rank is positive.
[[nodiscard]] double metric_of_rank(Metric metric, double rank);

}  // namespace dmoscope
