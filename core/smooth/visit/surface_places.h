#pragma once
// Places of a vertex that slides on a surface: the ends of straight ways in the plane that touches it at the vertex, taken down to the
// facet beneath; not beyond a feature edge, nor where the surface turns away.

#include <algorithm>
#include <optional>

#include "core/base/rounding.h"
#include "core/smooth/visit/search_room.h"
#include "core/smooth/visit/sliding_domain.h"

namespace dmoscope {

/// Places on a surface. Coordinates are steps in the tangent plane in units of the star's scale, ways are such steps in mesh units. Frame:
/// Space or Curved.
template <class Frame>
class SurfacePlaces {
 public:
  using Coordinates = Vec2<double>;
  using Offset = OffsetIn<Frame, double>;
  static constexpr bool kFree = false;

  /// Makes the places; none where the vertex stands beside the surface. All arguments must outlive it; `scale`: that of the vertex's star.
  [[nodiscard]] static std::optional<SurfacePlaces> of(const SlidingDomain& domain, const MeshView<Frame>& mesh, PositionView positions,
                                                       Index vertex, double scale, SearchRoom<Frame>& room) {
    const auto place = domain.place(vertex, positions[vertex]);
    if (!place) return std::nullopt;
    const Vec3 normal = domain.facets().normal(*place);
    if (normal == Vec3{}) return std::nullopt;
    return SurfacePlaces(domain, mesh, positions, vertex, scale, room, *place, tangent_plane(normal));
  }

  [[nodiscard]] Coordinates here() const { return {}; }
  [[nodiscard]] std::optional<Offset> offset(Coordinates at) const {
    if (at == Coordinates{}) return Offset{};
    if (!walks_) walks_.emplace(domain_.facets(), place_.facet, plane_, positions_[vertex_], kSteepest, room_.walks);
    const auto found = walks_->to(times(at, scale_));
    if (!found) return std::nullopt;
    return times(mesh_.frame.offset(domain_.facets().at(*found), positions_[vertex_]), 1.0 / scale_);
  }
  [[nodiscard]] Coordinates shifted(Coordinates by) const { return by; }
  [[nodiscard]] Coordinates way(Coordinates to) const { return times(to, scale_); }
  [[nodiscard]] Coordinates slope(Coordinates /*at*/, Vec3 gradient) const { return plane_.project(gradient); }
  [[nodiscard]] double unit() const { return 1.0; }

  [[nodiscard]] static int candidates_per_axis(int grid_points) { return grid_points; }
  template <class F>
  void for_grid(Coordinates centre, double omega, int grid_points, const F& f) const {
    const CandidateGrid<double> grid{centre, times(box(), omega), grid_points};
    for (int i = 0; i < grid.points; ++i) grid.for_slice(i, [&f](int /*index*/, const Coordinates& p) { f(p); });
  }
  [[nodiscard]] std::optional<Coordinates> middle() const { return std::nullopt; }
  /// Mean length of the edges of the surface at the vertex, in units of the star's scale.
  [[nodiscard]] double edge() const {
    double sum = 0.0, count = 0.0;
    for_neighbours([&](Vec3 way) { sum += length(way), count += 1.0; });
    return sum / (count * scale_);
  }
  [[nodiscard]] Coordinates way_to_mean(double relaxation) const {
    Vec3 sum{};
    double count = 0.0;
    for_neighbours([&](Vec3 way) { sum = sum + way, count += 1.0; });
    return times(times(plane_.project(sum), relaxation / (count * scale_)), scale_);
  }
  [[nodiscard]] Coordinates along(Vec3 direction) const { return plane_.project(direction); }
  /// Width and height of the box around the star's other vertices in the tangent plane, in units of the star's scale.
  [[nodiscard]] Coordinates box() const {
    if (box_) return *box_;
    Coordinates low{}, high{};
    for (const Incidence& at : mesh_.star(vertex_)) {
      for (const Index other : mesh_.corners_of(at.element)) {
        const Coordinates p = plane_.offset(positions_[other], positions_[vertex_]);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    box_ = times(high - low, 1.0 / scale_);
    return *box_;
  }
  [[nodiscard]] const Plane& plane() const { return plane_; }
  [[nodiscard]] Coordinates way_along(Vec2<double> way) const { return way; }

  template <class F>
  void for_star(const F& f) const {
    for (const Incidence& at : mesh_.star(vertex_)) f(mesh_.corners_of(at.element), at.corner, positions_);
  }

  /// Goes the longest way there, or half of it and so on, that confirm(place) allows and that keeps near the input.
  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> go(Coordinates way, const Confirm& confirm) const {
    for (int i = 0; i <= kHalvings && !(way == Coordinates{}); ++i, way = times(way, 0.5))
      if (const auto target = possible(way, confirm)) return target;
    return std::nullopt;
  }

 private:
  static constexpr int kHalvings = 3;  // number of times that a way is halved

  SurfacePlaces(const SlidingDomain& domain, const MeshView<Frame>& mesh, PositionView positions, Index vertex, double scale,
                SearchRoom<Frame>& room, const FacetPlace& place, const Plane& plane)
      : domain_(domain), mesh_(mesh), positions_(positions), vertex_(vertex), scale_(scale), room_(room), place_(place), plane_(plane) {}

  /// Calls f(way) with the way to the other end of each edge of the surface at the vertex; each comes twice.
  template <class F>
  void for_neighbours(const F& f) const {
    const SlidingFaces& faces = domain_.faces();
    for (const Index face : faces.at(vertex_)) {
      const auto corners = faces.table().corners(face);
      const auto at = static_cast<std::size_t>(std::ranges::find(corners, vertex_) - corners.begin());
      for (const std::size_t steps : {std::size_t{1}, corners.size() - 1})
        f(positions_[corners[(at + steps) % corners.size()]] - positions_[vertex_]);
    }
  }

  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> possible(Coordinates way, const Confirm& confirm) const {
    const Vec3 here = positions_[vertex_];
    const auto there = domain_.facets().walk(place_.facet, plane_, here, way, kSteepest);
    if (!there) return std::nullopt;
    Vec3 target = domain_.facets().at(*there);
    if (domain_.single_precision()) {
      target = {nearest_float(target.x), nearest_float(target.y), nearest_float(target.z)};
      if (!domain_.faces().place(vertex_, target)) return std::nullopt;
    }
    const Index follower = domain_.follower(vertex_);
    const Vec3 behind = follower != kNoIndex ? domain_.place_of_follower(vertex_, target) : Vec3{};
    const auto beneath = follower != kNoIndex ? domain_.faces().place(follower, behind) : std::nullopt;
    if (follower != kNoIndex && !beneath) return std::nullopt;
    if (confirm(target) != Confirmation::Gains) return std::nullopt;
    if (!domain_.bound().allows_faces(positions_, {vertex_, here, target, &place_, &*there}, room_.overlay, fit_now_)) return std::nullopt;
    if (follower != kNoIndex && !follows_near(follower, behind, *beneath)) return std::nullopt;
    domain_.expect(vertex_, there->facet);
    return target;
  }
  [[nodiscard]] bool follows_near(Index follower, Vec3 target, const FacetPlace& beneath) const {
    const auto now = domain_.place(follower, positions_[follower]);
    const auto move = [&] { return DeviationBound::Move{follower, positions_[follower], target, &*now, &beneath}; };
    if (!now || !domain_.bound().allows_faces(positions_, move(), room_.overlay, fit_of_follower_)) return false;
    domain_.expect(follower, beneath.facet);
    return true;
  }

  const SlidingDomain& domain_;
  const MeshView<Frame>& mesh_;
  PositionView positions_;
  Index vertex_;
  double scale_;
  SearchRoom<Frame>& room_;
  FacetPlace place_;
  Plane plane_;  // touches the surface at the vertex
  mutable std::optional<Coordinates> box_{};
  mutable std::optional<FacetWalks> walks_{};
  mutable std::optional<Fit> fit_now_{}, fit_of_follower_{};  // fits of the faces around, once known
};

}  // namespace dmoscope
