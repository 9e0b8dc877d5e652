#pragma once
// Places of a free vertex: the plane of a planar mesh, or all of space.

#include <optional>
#include <vector>

#include "core/smooth/edge_neighbours.h"
#include "core/smooth/vertex_rule.h"
#include "core/smooth/visit/search_room.h"

namespace dmoscope {

/// Mean length of the edges at a star's vertex, in units of the star's scale; an edge counts once for each of its elements.
[[nodiscard]] double mean_edge(const Star<double>& star);
[[nodiscard]] double mean_edge(const VolumeStar<double>& star);

/// Places of a free vertex. Coordinates are offsets in units of the star's scale. A way is one in mesh units. Frame: Plane or Space.
template <class Frame>
class FreePlaces {
 public:
  using Coordinates = OffsetIn<Frame, double>;
  static constexpr bool kFree = true;
  /// `star`: that of the vertex, for searches. All arguments must outlive it.
  FreePlaces(const RuleMesh<Frame>& mesh, PositionView positions, Index vertex, const StarIn<Frame, double>& star)
      : mesh_(mesh), positions_(positions), vertex_(vertex), star_(star) {}

  [[nodiscard]] Coordinates here() const { return {}; }
  [[nodiscard]] std::optional<Coordinates> offset(Coordinates at) const { return at; }
  [[nodiscard]] Coordinates shifted(Coordinates by) const { return by; }
  [[nodiscard]] Coordinates way(Coordinates to) const { return times(to, star_.scale); }
  /// Turns a gradient by offsets into one by coordinates at a place.
  [[nodiscard]] Coordinates slope(Coordinates /*at*/, Coordinates gradient) const { return gradient; }
  /// Distance that the coordinates cover in a unit of the star's scale.
  [[nodiscard]] double unit() const { return 1.0; }

  [[nodiscard]] static int candidates_per_axis(int grid_points) { return grid_points; }
  /// Calls f(coordinates) for each candidate of a level.
  template <class F>
  void for_grid(Coordinates centre, double omega, int grid_points, const F& f) const {
    const CandidateGrid<double, Coordinates> grid{centre, times(star_.box, omega), grid_points};
    for (int i = 0; i < grid.points; ++i) grid.for_slice(i, [&f](int /*index*/, const Coordinates& p) { f(p); });
  }
  /// Mean of the other corners, from which the search of a tangled star may begin.
  [[nodiscard]] std::optional<Coordinates> middle() const { return middle_of<Coordinates>(StarViewIn<Frame, double>(star_)); }
  /// Mean length of its edges.
  [[nodiscard]] double edge() const { return mean_edge(star_); }
  /// Way to the mean of its neighbours, or the share `relaxation` of it.
  [[nodiscard]] Coordinates way_to_mean(double relaxation) const {
    Vec3 sum{};
    double count = 0.0;
    for_neighbours([&](Index other) { sum = sum + mesh_.view.frame.difference(positions_[other], positions_[vertex_]), count += 1.0; });
    return times(mesh_.view.frame.project(1.0 / count * sum), relaxation);
  }
  /// Coordinates that lead along a direction of space, and the width of the star's box along that.
  [[nodiscard]] Coordinates along(Vec3 direction) const { return mesh_.view.frame.project(direction); }
  [[nodiscard]] Coordinates box() const { return star_.box; }
  /// Plane in which angles around the vertex are seen, and the way that leads along one in that.
  [[nodiscard]] Plane plane() const requires std::is_same_v<Frame, Plane> { return mesh_.view.frame; }
  [[nodiscard]] Coordinates way_along(Vec2<double> way) const requires std::is_same_v<Frame, Plane> { return way; }
  /// Calls f(corners, which of them the vertex is, positions) for each element around it.
  template <class F>
  void for_star(const F& f) const {
    for (const Incidence& at : mesh_.view.star(vertex_)) f(mesh_.view.corners_of(at.element), at.corner, positions_);
  }

  [[nodiscard]] const StarIn<Frame, double>& star() const { return star_; }

  /// Goes the longest part of the way that confirm(place) allows, and returns the new position; none where it stays.
  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> go(Coordinates way, const Confirm& confirm) const {
    if (way == Coordinates{}) return std::nullopt;
    return mesh_.moved_if(positions_[vertex_], way, confirm);
  }

 private:
  template <class F>
  void for_neighbours(const F& f) const {
    if constexpr (std::is_same_v<Frame, Plane>) {
      for_edge_neighbours(mesh_.view, vertex_, f);
    } else {
      thread_local std::vector<Index> neighbours;  // kept: a visit allocates nothing
      gather_edge_neighbours(mesh_.view, vertex_, neighbours);
      for (const Index other : neighbours) f(other);
    }
  }

  const RuleMesh<Frame>& mesh_;
  PositionView positions_;
  Index vertex_;
  const StarIn<Frame, double>& star_;
};

}  // namespace dmoscope
