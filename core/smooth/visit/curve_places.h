#pragma once
// Places of a vertex that slides along a curve: those between its neighbours there.

#include <algorithm>
#include <optional>

#include "core/smooth/edge_neighbours.h"
#include "core/smooth/visit/search_room.h"
#include "core/smooth/visit/sliding_domain.h"

namespace dmoscope {

/// Places on a curve. Coordinates, and ways to them, are lengths along it in mesh units. Frame: Plane, Space or Curved.
template <class Frame>
class CurvePlaces {
 public:
  using Coordinates = double;
  using Offset = OffsetIn<Frame, double>;
  static constexpr bool kFree = false;

  /// Makes the places; none where the vertex, or a neighbour, stands beside the curve. All arguments must outlive it; `scale`: that of the
  /// vertex's star.
  [[nodiscard]] static std::optional<CurvePlaces> of(const SlidingDomain& domain, const MeshView<Frame>& mesh, PositionView positions,
                                                     Index vertex, double scale, SearchRoom<Frame>& room) {
    const auto place = domain.curves().place(vertex, positions[vertex]);
    if (!place) return std::nullopt;
    const auto beside = domain.curves().neighbours(vertex, *place, positions);
    if (!beside) return std::nullopt;
    return CurvePlaces(domain, mesh, positions, vertex, scale, room, *place, *beside);
  }

  [[nodiscard]] double here() const { return place_; }
  /// Offset of a place in units of the scale; none beyond the neighbours.
  [[nodiscard]] std::optional<Offset> offset(double at) const {
    if (at == place_) return Offset{};
    if (!(beside_.place_before < at && at < beside_.place_after)) return std::nullopt;
    return offset_to(domain_.curves().at(vertex_, at));
  }
  [[nodiscard]] double shifted(double by) const { return place_ + by; }
  [[nodiscard]] double way(double to) const { return to; }
  /// Turns a gradient by offsets into the slope along the curve, taken by the straight between two places next to it.
  template <class Gradient>
  [[nodiscard]] double slope(double at, Gradient gradient) const {
    const auto [before, after] = ends_around(at);
    return dot(plain(offset_to(after) - offset_to(before)), gradient) / (kAround * stretch());
  }
  [[nodiscard]] double unit() const { return scale_; }

  /// Gives n * n candidates a level, as many as a free vertex in a plane has.
  [[nodiscard]] static int candidates_per_axis(int grid_points) { return grid_points * grid_points; }
  template <class F>
  void for_grid(double centre, double omega, int grid_points, const F& f) const {
    const int count = candidates_per_axis(grid_points);
    const double width = omega * stretch();
    for (int i = 0; i < count; ++i) f(centre + width * (static_cast<double>(i) / (count - 1) - 0.5));
  }
  [[nodiscard]] std::optional<double> middle() const { return std::nullopt; }
  [[nodiscard]] double edge() const { return 0.5 * stretch(); }
  /// Way to the middle of the two neighbours along the curve, or the share `relaxation` of it.
  [[nodiscard]] double way_to_mean(double relaxation) const {
    return place_ + relaxation * (0.5 * (beside_.place_before + beside_.place_after) - place_);
  }
  /// Plane in which angles around the vertex are seen: on a curved surface the one that touches it.
  [[nodiscard]] Plane plane() const requires(!std::is_same_v<Frame, Space>) {
    if constexpr (std::is_same_v<Frame, Plane>) {
      return mesh_.frame;
    } else {
      Vec3 sum{};
      for_star([&sum](std::span<const Index> corners, Index corner, PositionView positions) {
        const auto to = [&](std::size_t steps) {
          return positions[corners[(corner + steps) % corners.size()]] - positions[corners[corner]];
        };
        sum = sum + cross(to(1), to(corners.size() - 1));
      });
      const double size = length(sum);
      return tangent_plane(size > 0.0 ? (1.0 / size) * sum : mesh_.frame.normal);
    }
  }
  /// Way along the curve for one in the plane, not more than halfway to a neighbour.
  [[nodiscard]] double way_along(Vec2<double> way) const requires(!std::is_same_v<Frame, Space>) {
    const auto [before, after] = ends_around(place_);
    const double to = place_ + dot(plane().lift(way), after - before) / (kAround * stretch());
    return std::clamp(to, 0.5 * (place_ + beside_.place_before), 0.5 * (place_ + beside_.place_after));
  }

  template <class F>
  void for_star(const F& f) const {
    for (const Incidence& at : mesh_.star(vertex_)) f(mesh_.corners_of(at.element), at.corner, positions_);
  }

  /// Goes the longest way there, or half of it and so on, that confirm(place) allows and that keeps near the input; in a plane the whole
  /// way alone.
  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> go(double to, const Confirm& confirm) const {
    for (int i = 0; i <= kHalvings && to != place_; ++i) {
      if (const auto target = possible(to, confirm)) return target;
      if constexpr (std::is_same_v<Frame, Plane>) break;
      to = place_ + 0.5 * (to - place_);
    }
    return std::nullopt;
  }

 private:
  static constexpr int kHalvings = 3;      // number of times that a way is halved
  static constexpr double kAround = 1e-6;  // share of the stretch: distance of two places next to each other

  CurvePlaces(const SlidingDomain& domain, const MeshView<Frame>& mesh, PositionView positions, Index vertex, double scale,
              SearchRoom<Frame>& room, double place, const Curves::Neighbours& beside)
      : domain_(domain), mesh_(mesh), positions_(positions), vertex_(vertex), scale_(scale), room_(room), place_(place), beside_(beside) {}

  [[nodiscard]] double stretch() const { return beside_.place_after - beside_.place_before; }
  [[nodiscard]] Offset offset_to(Vec3 there) const { return times(mesh_.frame.offset(there, positions_[vertex_]), 1.0 / scale_); }
  [[nodiscard]] std::pair<Vec3, Vec3> ends_around(double at) const {
    const double half = 0.5 * kAround * stretch();
    return {domain_.curves().point_at(vertex_, at - half), domain_.curves().point_at(vertex_, at + half)};
  }
  [[nodiscard]] static auto plain(const Offset& offset) {
    if constexpr (std::is_same_v<Frame, Curved>)
      return offset.v;
    else
      return offset;
  }

  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> possible(double place, const Confirm& confirm) const {
    if (!(beside_.place_before < place && place < beside_.place_after)) return std::nullopt;
    const Vec3 target = domain_.curves().at(vertex_, place);
    if (!is_between(vertex_, target)) return std::nullopt;
    const Index follower = domain_.follower(vertex_);
    const Vec3 behind = follower != kNoIndex ? domain_.place_of_follower(vertex_, target) : Vec3{};
    if (follower != kNoIndex && !is_between(follower, behind)) return std::nullopt;
    if (confirm(target) != Confirmation::Gains) return std::nullopt;
    if (!keeps_near({vertex_, positions_[vertex_], target}, place_, place, beside_, fit_now_)) return std::nullopt;
    return follower == kNoIndex || follows_near(follower, behind) ? std::optional(target) : std::nullopt;
  }
  /// Returns whether a vertex is still between its neighbours: rounding may put it elsewhere.
  [[nodiscard]] bool is_between(Index vertex, Vec3 target) const {
    const auto landed = domain_.curves().place(vertex, target);
    return landed && domain_.curves().neighbours(vertex, *landed, positions_);
  }
  /// Returns whether edges and faces stay as near to the input as they must.
  [[nodiscard]] bool keeps_near(const DeviationBound::Move& move, double from, double to, const Curves::Neighbours& beside,
                                std::optional<Fit>& fit_now) const {
    const DeviationBound& bound = domain_.bound();
    const auto deviation = [&](double at, Vec3 position) { return bound.along_curve(positions_, move.vertex, beside, at, position); };
    const double there = deviation(to, move.to);
    if (!(there <= bound.most()) && !(there <= deviation(from, move.from))) return false;
    return bound.allows_faces(positions_, move, room_.overlay, fit_now);
  }
  [[nodiscard]] bool follows_near(Index follower, Vec3 target) const {
    const Curves& curves = domain_.curves();
    const auto from = curves.place(follower, positions_[follower]), to = curves.place(follower, target);
    const auto beside = from ? curves.neighbours(follower, *from, positions_) : std::nullopt;
    return beside && to && keeps_near({follower, positions_[follower], target}, *from, *to, *beside, fit_of_follower_);
  }

  const SlidingDomain& domain_;
  const MeshView<Frame>& mesh_;
  PositionView positions_;
  Index vertex_;
  double scale_;
  SearchRoom<Frame>& room_;
  double place_;
  Curves::Neighbours beside_;
  mutable std::optional<Fit> fit_now_{}, fit_of_follower_{};  // fits of the faces around, once known
};

}  // namespace dmoscope
