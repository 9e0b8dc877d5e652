#pragma once
// One vertex's visit in double by the plain search, judged by the statistics' own formulas: what the fast search is compared with, and
// falls back to. For any processor.

#include <limits>

#include "core/base/anywhere.h"
#include "core/quality/element_shape.h"
#include "core/search/grid_search.h"
#include "core/search/mesh_star.h"
#include "core/search/untangling.h"
#include "core/smooth/displace.h"

namespace dmoscope {

/// How good a star is, judged in double by the very formulas of the statistics. While one of its elements is inverted its smallest
/// normalised Jacobian counts, afterwards its least metric. Of volumes only those corners count that the vertex's place changes: the others
/// keep their bits, so that no star's least gets worse where these do not.
struct StarState {
  double jacobian = 0.0;    // least of smallest corner Jacobian / reference measure
  double quality = 0.0;     // least metric (paper eq. 1)
  double untangling = 0.0;  // what is raised while `jacobian` is <= 0, and does not fall: itself, or of a volume see UntanglingMean
  /// Strictly better: what a move must be (promise 1).
  [[nodiscard]] DMOSCOPE_ANYWHERE bool better_than(const StarState& other) const noexcept {
    if (other.jacobian <= 0.0) return jacobian > 0.0 || (jacobian >= other.jacobian && untangling > other.untangling);
    return jacobian > 0.0 && quality > other.quality;
  }
};

/// With the vertex at `place`. Frame: Plane or Space.
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE StarState star_state(const MeshView<Frame>& mesh, PositionView positions, Index vertex, Vec3 place) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr bool kVolume = std::is_same_v<Frame, Space>;
  StarState state{kInfinity, kInfinity, 0.0};
  [[maybe_unused]] UntanglingMean untangling;
  const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
  for (const Incidence& incidence : mesh.star(vertex)) {
    const double reference = mesh.reference_measure[incidence.element];
    const Index moving = incidence.corner;
    visit_shape(mesh.frame, mesh.corners_of(incidence.element), at, [&](const auto& shape) {
      state.jacobian = scalar::min(state.jacobian, formulas::smallest_jacobian_around(shape, moving) / reference);
      state.quality = scalar::min(state.quality, evaluate_around<M>(shape, moving));
      if constexpr (kVolume) untangling.add(shape, moving, reference);
    });
  }
  state.untangling = kVolume ? untangling.value() : state.jacobian;
  return state;
}

/// Exactly: would the vertex gain by standing at `target`? A search may be in float and in other rounding than the statistics.
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE bool gains_at(const MeshView<Frame>& mesh, PositionView positions, Index vertex, Vec3 target) {
  return star_state<M>(mesh, positions, vertex, target).better_than(star_state<M>(mesh, positions, vertex, positions[vertex]));
}

/// The untangling objective costs more and is needed only where an element of the star is inverted now; of one without, it finds the
/// same candidate, since there every candidate it values otherwise is <= 0 and cannot win. Returns the offset, in units of the star's
/// scale. Point: of the plane or of space.
template <Metric M, class StarT, class Point, class Team = Solo, class Trace = NoTrace>
[[nodiscard]] DMOSCOPE_ANYWHERE Point search_star(const StarT& star, Point box, const SearchParameters& parameters, const Team& team = {},
                                                  Trace&& trace = {}) {
  const UntanglingObjective<M, StarT, Point> untangling(star);
  if (!(untangling(Point{}) > 0.0)) return grid_search<double>(untangling, box, parameters, trace, team).offset;
  return grid_search<double>(Objective<M, false, double, Value::Metric, StarT>(star), box, parameters, trace, team).offset;
}

/// Where a vertex at `place` comes to stand by an offset in the frame, in mesh units. `single`: see Mesh::single_precision.
template <class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3 displaced(const Frame& frame, Vec3 place, OffsetIn<Frame, double> offset, bool single) {
  const Vec3 step = frame.lift(offset);
  Vec3 to{displaced(place.x, step.x, single), displaced(place.y, step.y, single), displaced(place.z, step.z, single)};
  if constexpr (std::is_same_v<Frame, Plane>)
    if (frame.period > 0.0) to.x = settled(to.x, frame.west, frame.period, single);
  return to;
}

}  // namespace dmoscope
