#pragma once
// Stars read by their indices, and comparisons of two places by the kernels' results, which spare fast searches most of the work around
// them.

#include <vector>

#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/search/star.h"
#include "core/smooth/kernels/indexed_stars.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope {

/// Places of a star's other vertices. Frame: Plane or Space.
template <class Frame>
struct StarPoints {
  using Offset = OffsetIn<Frame, double>;
  std::vector<Vec3> at;         // positions
  std::vector<Offset> offsets;  // offsets from the vertex, in units of scale: see MeshStar
  Offset box{};                 // box of the offsets
  double scale = 1.0;
};
/// Fills the points of a star. Their vectors are kept.
template <class Frame>
void gather_points(const Frame& frame, const IndexedStars::Star& star, PositionView positions, Index vertex, StarPoints<Frame>& points);
/// Fills a star as gather_star() does, but for the elements' reference measures. `points`: those of the star.
template <class Frame>
void fill_star(const IndexedStars::Star& star, const StarPoints<Frame>& points, StarIn<Frame, double>& out);

/// Answer whether one value of a metric, a rank or a mean is greater than another, both found in double by the search's formulas.
enum class Certainty { Greater, Less, Unsure };
/// Compares values from kLeastCertain on. Unsure where rounding may decide: the statistics' formulas have to.
[[nodiscard]] inline Certainty compare(double a, double b) {
  constexpr double kDoubt = 1e-8;  // far more than rounding
  if (a > b * (1.0 + kDoubt)) return Certainty::Greater;
  return a < b * (1.0 - kDoubt) ? Certainty::Less : Certainty::Unsure;
}
inline constexpr double kLeastCertain = 1e-4;

/// Returns whether all elements of the star of a volume have the metric, so that the kernels judge all of it.
[[nodiscard]] bool has_metric(const IndexedStar& star, Metric metric);
/// Metric of a volume element whose rank is positive.
[[nodiscard]] double metric_of_rank(Metric metric, double rank);

}  // namespace dmoscope
