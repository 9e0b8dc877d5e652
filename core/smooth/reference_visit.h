#pragma once
// Visit of one vertex in double by the plain search, judged by the statistics' own formulas. The fast search is compared with it and falls
// back to it. For any processor.

#include <cstdint>
#include <limits>

#include "core/base/host_device.h"
#include "core/quality/element_shape.h"
#include "core/quality/validity.h"
#include "core/search/grid_search.h"
#include "core/search/mesh_star.h"
#include "core/search/untangling.h"
#include "core/smooth/displace.h"

namespace dmoscope {

/// Quality of a star, judged in double by the very formulas of the statistics. In volumes only those corners count that the vertex's place
/// changes, but for `inverted` and `sound`: the others keep their bits, so that no star's least gets worse where these do not.
struct StarState {
  double jacobian = 0.0;    // least of smallest corner Jacobian / reference measure
  double quality = 0.0;     // least metric (paper eq. 1)
  double untangling = 0.0;  // see UntanglingMean: an attempt raises it while `jacobian` is <= 0
  int inverted = 0;         // number of inverted elements
  double sound = 0.0;       // least metric of the elements that are not inverted
  /// Returns whether the star is strictly better, as every move must make it (promise 1).
  [[nodiscard]] DMOSCOPE_ANYWHERE bool better_than(const StarState& other, const Untangling& rule = {}) const noexcept {
    if (rule.repair) return !(other.jacobian > 0.0) && jacobian > 0.0 && inverted < other.inverted && quality >= Untangling::kRepaired;
    if (other.jacobian > 0.0) return jacobian > 0.0 && quality > other.quality;
    if (inverted > other.inverted || quality < scalar::min(other.quality, rule.attempt ? rule.floor : other.quality)) return false;
    if (jacobian > 0.0) return true;
    if (rule.attempt) return jacobian > other.jacobian || (jacobian == other.jacobian && untangling > other.untangling);
    return inverted < other.inverted || sound > other.sound;
  }
};

/// State of a star with the vertex at `place`. Frame: Plane or Space. quality_of(incidence, shape): the metric of one element, of the part
/// that the vertex changes.
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

/// Change of the soundness of a star's elements by a move, at their corners and inside (see validity.h).
struct SoundnessChange {
  int lost = 0, won = 0;     // elements that are sound only before, and only after
  bool lost_inside = false;  // whether one of the former may be inverted inside: see has_inside()
};
/// Compares the star at two places. `counts_won`: else `won` is 0.
template <class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE SoundnessChange soundness_change(const MeshView<Frame>& mesh, PositionView positions,
                                                                                 Index vertex, Vec3 target, bool counts_won) {
  SoundnessChange change;
  for (const Incidence& incidence : mesh.star(vertex)) {
    bool inverted_there = false, inside = false;
    DMOSCOPE_NO_UNROLL
    for (int i = 0; i < 2; ++i) {  // both places in a loop, so that a device's code has one copy
      const Vec3 place = i == 0 ? target : positions[vertex];
      const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
      const bool inverted =
          visit_shape(mesh.frame_of(incidence.element), mesh.corners_of(incidence.element), at, [&inside]<class Shape>(const Shape& shape) {
            inside = kHasInside<Shape>;
            return least_jacobian(shape) <= 0.0;
          });
      if (i == 0) {
        inverted_there = inverted;
        if (!inverted && !counts_won) break;
      } else if (inverted != inverted_there) {
        ++(inverted ? change.won : change.lost);
        change.lost_inside = change.lost_inside || (!inverted && inside);
      }
    }
  }
  return change;
}

/// Returns whether every element of the star that is sound now stays so with the vertex at `target`.
template <class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool keeps_sound(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                 Vec3 target) {
  return soundness_change(mesh, positions, vertex, target, false).lost == 0;
}

/// Returns whether an element of the star is inverted, inside where its corners tell of none.
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool has_inverted(const MeshView<Space>& mesh, PositionView positions, Index vertex) {
  for (const Incidence& incidence : mesh.star(vertex)) {
    const auto at = [&](Index v) { return positions[v]; };
    if (visit_volume(mesh.corners_of(incidence.element), at, [](const auto& shape) { return !(least_jacobian(shape) > 0.0); })) return true;
  }
  return false;
}

/// Judgement of a place that a search has found, by the statistics' formulas. TooFar: the vertex would gain there, but a hexahedron or
/// wedge would become inverted, or a guard be broken; a place nearer to its present one may do.
enum class Confirmation : std::uint8_t { GainsNothing, Gains, TooFar };

/// Confirms the soundness at a place that is better. `tangled`: whether an element of the star is inverted at a corner that the vertex
/// changes. None may become inverted, not inside either.
template <class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Confirmation confirm_soundness(const MeshView<Frame>& mesh, PositionView positions,
                                                                               Index vertex, Vec3 target, bool tangled) {
  // Accepts planar stars whose corners were judged before: without volume the corners tell all.
  if (!std::is_same_v<Frame, Space> && !tangled) return Confirmation::Gains;
  const SoundnessChange change = soundness_change(mesh, positions, vertex, target, false);
  if (change.lost == 0) return Confirmation::Gains;
  return change.lost_inside ? Confirmation::TooFar : Confirmation::GainsNothing;
}

/// Confirms a place `target` for a vertex whose star is `before`, and after() there.
template <class Frame, class After>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Confirmation confirm_from(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                          Vec3 target, const Untangling& rule, const StarState& before,
                                                                          const After& after) {
  const StarState there = after();
  if (there.better_than(before, rule)) return confirm_soundness(mesh, positions, vertex, target, !(before.jacobian > 0.0));
  // Decides as UntanglingObjective does for elements that are inverted inside alone.
  if (!std::is_same_v<Frame, Space> || !rule.looks_inside() || !(before.jacobian > 0.0) || !(there.jacobian > 0.0) ||
      there.quality < scalar::min(before.quality, rule.floor))
    return Confirmation::GainsNothing;
  const SoundnessChange change = soundness_change(mesh, positions, vertex, target, true);
  return change.lost == 0 && change.won > 0 ? Confirmation::Gains : Confirmation::GainsNothing;
}

/// Confirms a place exactly: a search may be in float and in other rounding than the statistics.
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Confirmation confirm_at(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                        Vec3 target, const Untangling& rule) {
  return confirm_from(mesh, positions, vertex, target, rule, star_state<M>(mesh, positions, vertex, positions[vertex]),
                      [&]() DMOSCOPE_INLINE_LAMBDA { return star_state<M>(mesh, positions, vertex, target); });
}
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool gains_at(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                              Vec3 target, const Untangling& rule) {
  return confirm_at<M>(mesh, positions, vertex, target, rule) == Confirmation::Gains;
}

/// Move of a vertex, if it gains.
struct ConfirmedMove {
  bool gains = false;
  Vec3 to{};
};
/// Number of times that a step is halved if it would invert a hexahedron or wedge.
inline constexpr int kMostHalvings = 4;
/// Longest of a step, its half and so on that gains without inverting an element inside. place(step): its end; confirm(place): its
/// judgement.
template <class Offset, class Place, class Confirm>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE ConfirmedMove confirmed_move(Offset step, const Place& place, const Confirm& confirm) {
  ConfirmedMove move;
  DMOSCOPE_NO_UNROLL
  for (int i = 0; i <= kMostHalvings; ++i) {
    move.to = place(step);
    const Confirmation found = confirm(move.to);
    move.gains = found == Confirmation::Gains;
    if (found != Confirmation::TooFar) break;
    step = times(step, 0.5);
  }
  return move;
}

/// Searches a star. The untangling objective costs more and is needed only where an element of the star is inverted now; in a repair
/// nothing else is looked at. Returns the offset, in units of the star's scale. Point: one of the plane or of space.
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

/// Position of a vertex at `place` after an offset in the frame, in mesh units. `single`: see Mesh::single_precision.
template <class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3 displaced(const Frame& frame, Vec3 place, OffsetIn<Frame, double> offset, bool single) {
  const Vec3 step = frame.lift(offset);
  Vec3 to{displaced(place.x, step.x, single), displaced(place.y, step.y, single), displaced(place.z, step.z, single)};
  if constexpr (std::is_same_v<Frame, Plane>)
    if (frame.period > 0.0) to.x = settled(to.x, frame.west, frame.period, single);
  return to;
}

}  // namespace dmoscope
