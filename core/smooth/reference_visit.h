#pragma once
// One vertex's visit in double by the plain search, judged by the statistics' own formulas. The fast search is compared with it and falls
// back to it. For any processor.

#include <limits>

#include "core/base/host_device.h"
#include "core/quality/element_shape.h"
#include "core/search/grid_search.h"
#include "core/search/mesh_star.h"
#include "core/search/untangling.h"
#include "core/smooth/displace.h"

namespace dmoscope {

/// How good a star is, judged in double by the very formulas of the statistics. Of volumes only those corners count that the vertex's place
/// changes, but in `inverted` and `sound`: the others keep their bits, so that no star's least gets worse where these do not.
struct StarState {
  double jacobian = 0.0;    // least of smallest corner Jacobian / reference measure
  double quality = 0.0;     // least metric (paper eq. 1)
  double untangling = 0.0;  // see UntanglingMean: what an attempt raises while `jacobian` is <= 0
  int inverted = 0;         // elements
  double sound = 0.0;       // least metric of those that are not inverted
  /// Strictly better: what a move must be (promise 1).
  [[nodiscard]] DMOSCOPE_ANYWHERE bool better_than(const StarState& other, const Untangling& rule = {}) const noexcept {
    if (rule.repair) return !(other.jacobian > 0.0) && jacobian > 0.0 && inverted < other.inverted && quality >= Untangling::kRepaired;
    if (other.jacobian > 0.0) return jacobian > 0.0 && quality > other.quality;
    if (inverted > other.inverted || quality < scalar::min(other.quality, rule.attempt ? rule.floor : other.quality)) return false;
    if (jacobian > 0.0) return true;
    if (rule.attempt) return jacobian > other.jacobian || (jacobian == other.jacobian && untangling > other.untangling);
    return inverted < other.inverted || sound > other.sound;
  }
};

/// With the vertex at `place`. Frame: Plane or Space. quality_of(incidence, shape): the metric of one element, of what the vertex changes.
template <class Frame, class QualityOf>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE StarState star_state_by(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                        Vec3 place, const QualityOf& quality_of) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  StarState state{kInfinity, kInfinity, 0.0, 0, kInfinity};
  UntanglingMean mean;
  const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
  for (const Incidence& incidence : mesh.star(vertex)) {
    const double reference = mesh.reference_measure[incidence.element];
    const Index moving = incidence.corner;
    visit_shape(mesh.frame_of(incidence.element), mesh.corners_of(incidence.element), at, [&](const auto& shape) {
      const auto jacobian = corner_jacobians(shape, moving, [&](double each) { mean.add(each, reference); });
      const double quality = quality_of(incidence, shape);
      state.jacobian = scalar::min(state.jacobian, jacobian.around / reference);
      state.quality = scalar::min(state.quality, quality);
      if (jacobian.whole <= 0.0)
        ++state.inverted;
      else
        state.sound = scalar::min(state.sound, quality);
    });
  }
  state.untangling = mean.value();
  return state;
}
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE StarState star_state(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                     Vec3 place) {
  return star_state_by(mesh, positions, vertex, place, [](const Incidence& incidence, const auto& shape) DMOSCOPE_INLINE_LAMBDA {
    return evaluate_around<M>(shape, incidence.corner);
  });
}

/// Is every element of the star that is sound where the vertex stands sound with it at `target`, too?
template <class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool keeps_sound(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                 Vec3 target) {
  for (const Incidence& incidence : mesh.star(vertex)) {
    const auto is_inverted = [&](Vec3 place) {
      const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
      return visit_shape(mesh.frame_of(incidence.element), mesh.corners_of(incidence.element), at,
                         [](const auto& shape) { return formulas::smallest_jacobian(shape) <= 0.0; });
    };
    if (is_inverted(target) && !is_inverted(positions[vertex])) return false;
  }
  return true;
}

/// Would a vertex whose star is `before` gain by standing at `target`, where it is after()?
template <class Frame, class After>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool gains_from(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                Vec3 target, const Untangling& rule, const StarState& before,
                                                                const After& after) {
  if (!after().better_than(before, rule)) return false;
  return rule.attempt || before.jacobian > 0.0 || keeps_sound(mesh, positions, vertex, target);
}

/// Exactly: would the vertex gain by standing at `target`? A search may be in float and in other rounding than the statistics.
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool gains_at(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                              Vec3 target, const Untangling& rule) {
  return gains_from(mesh, positions, vertex, target, rule, star_state<M>(mesh, positions, vertex, positions[vertex]),
                    [&]() DMOSCOPE_INLINE_LAMBDA { return star_state<M>(mesh, positions, vertex, target); });
}

/// The untangling objective costs more and is needed only where an element of the star is inverted now; in a repair nothing else is looked
/// at. Returns the offset, in units of the
/// star's scale. Point: of the plane or of space.
template <Metric M, class StarT, class Point, class Team = Solo, class Trace = NoTrace>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Point search_star(const StarT& star, Point box, const SearchParameters& parameters,
                                                                  const Untangling& rule, const Team& team = {}, Trace&& trace = {}) {
  const UntanglingObjective<M, StarT, Point> untangling(star, rule);
  if (rule.repair && !untangling.tangled()) return {};
  if (untangling.tangled()) {
    const Point middle = middle_of<Point>(star);
    return grid_search<double>(untangling, box, parameters, trace, team, &middle).offset;
  }
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
