#pragma once
// Curves along which vertices slide: the boundary and interfaces of the input, or the feature edges of its surface, as polylines that no
// vertex ever leaves.

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"

namespace dmoscope {

/// A polyline along feature edges of a mesh.
struct FeatureLine {
  std::vector<Index> points;  // vertices along the line; of a closed one each once
  bool closed = false;
};
/// Feature lines made of the edges in `ends`: each from one held vertex to the next, or all around; in the order of the lowest vertex that
/// slides on each.
[[nodiscard]] std::vector<FeatureLine> chains(const CurveEnds& ends);

/// Feature lines of another mesh, along which vertices slide instead of along edges of their own.
struct OntoLines {
  std::vector<FeatureLine> lines;
  std::vector<Index> line_of;                     // by vertex of the mesh, the line that it slides along
  double beside = 0.0;                            // greatest distance of a vertex from its line, in mesh units
  std::vector<std::pair<Index, Vec3>> corners{};  // vertices of the mesh on corners of the other one, ascending, and these corners
};

/// Curves along which vertices slide. Places on a curve are lengths along it, in mesh units, from its first point; on a closed curve
/// without a corner they are periodic in its length. A vertex's place follows from its position: the place where its curve passes through
/// that, and of several the one nearest to the vertex's place in the input. The mesh must outlive them.
class Curves {
 public:
  /// Curves along edges of the input. `ends`: the vertices that slide, and their neighbours.
  Curves(const InputMesh& input, const CurveEnds& ends);
  /// Curves along lines of input.surface; `ends` still has the neighbours.
  Curves(const InputMesh& input, const CurveEnds& ends, const OntoLines& onto);

  [[nodiscard]] bool slides(Index vertex) const noexcept { return string_of_[vertex] != kNoIndex; }
  [[nodiscard]] Index curve_count() const noexcept { return static_cast<Index>(curves_.size()); }

  /// Place on its curve of a vertex that slides; none for one that is beside it.
  [[nodiscard]] std::optional<double> place(Index vertex, Vec3 position) const;
  /// The point at a place of the vertex's curve, rounded as the file holds it.
  [[nodiscard]] Vec3 at(Index vertex, double place) const;
  /// The point at a place of the vertex's curve in double, for searches along the curve in steps finer than a float's.
  [[nodiscard]] Vec3 point_at(Index vertex, double place) const;
  /// Period of the places in mesh units, the length of a closed curve; 0 for a curve that is not closed.
  [[nodiscard]] double period(Index vertex) const { return curve_of(vertex).closed ? curve_of(vertex).length() : 0.0; }
  /// Straight line from a place to the next point of the curve.
  struct Straight {
    Vec3 way;         // unit vector
    double distance;  // distance to that point, > 0
    double end;       // place of that point
  };
  /// The straight line from a place. `place`: from 0 to the curve's length. None at the end of an open curve.
  [[nodiscard]] std::optional<Straight> straight(Index vertex, double place, bool forwards) const;

  /// The neighbours of a vertex along its curve, and their places relative to its own. Sliding never passes them.
  struct Neighbours {
    Index before, after;
    double place_before, place_after;  // places; on a closed curve less than its length away from `place`
  };
  /// The neighbours of a vertex at `place`. None if a neighbour is beside the curve, or not on its side.
  [[nodiscard]] std::optional<Neighbours> neighbours(Index vertex, double place, PositionView positions) const;

  /// Exact distance of an edge from its stretch of the curve: the greatest distance of the curve's points between two places, first <=
  /// last, from the segment between the positions there. It is exact in both directions.
  [[nodiscard]] double deviation(Index vertex, double first, double last, Vec3 from, Vec3 to) const;

  /// Segments of a curve, from the first to the last; on a closed curve `first` may be greater than `last`.
  struct Stretch {
    Index curve;
    std::size_t first, last;
    [[nodiscard]] bool holds(std::size_t segment) const noexcept {
      return first <= last ? first <= segment && segment <= last : segment >= first || segment <= last;
    }
  };
  /// The stretch between a vertex that slides and a neighbour along the curve; none if `other` is no neighbour, or either is beside the
  /// curve.
  [[nodiscard]] std::optional<Stretch> stretch_to(Index vertex, Vec3 position, Index other, Vec3 position_of_other) const;
  /// The edges of the reference mesh around a place of the vertex's curve: the one that it lies on, and at that one's first end also the
  /// one before. kNoIndex: none.
  [[nodiscard]] std::array<std::pair<Index, Index>, 2> edges_at(Index vertex, double place) const;
  /// Calls visit(curve, segment, from, to) for all segments.
  template <class Visit>
  void for_segments(const Visit& visit) const {
    for (Index c = 0; c < curves_.size(); ++c)
      for (std::size_t i = 0; i < curves_[c].segments(); ++i) {
        const auto [from, to] = ends_of(curves_[c], i);
        visit(c, i, from, to);
      }
  }

  /// Calls visit(a, b) for all edges of the mesh along curves.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    for (const String& string : strings_)
      for (std::size_t i = string.closed ? 0 : 1; i < string.members.size(); ++i)
        visit(string.members[i > 0 ? i - 1 : string.members.size() - 1], string.members[i]);
  }

 private:
  struct Curve {
    std::vector<Index> points;    // indices into points_ along the curve; of a closed one without a corner each once
    std::vector<double> lengths;  // length from the first point to each point; of a closed curve also to the first again
    bool closed = false;
    [[nodiscard]] std::size_t segments() const { return lengths.size() - 1; }
    [[nodiscard]] double length() const { return lengths.back(); }
  };
  /// Vertices of the mesh along a curve in order, each joined to the next by an edge; the ends of an open string are held.
  struct String {
    Index curve = kNoIndex;
    std::vector<Index> members;
    std::vector<std::size_t> near;  // by member, a segment that it was near in the input
    bool closed = false;
  };
  struct Member {
    Index vertex;
    std::size_t near;
  };

  void take_strings(const CurveEnds& ends);
  void measure(Curve& curve) const;
  void put_along(const OntoLines& onto);
  void turn_along(String& string) const;
  [[nodiscard]] const Curve& curve_of(Index vertex) const { return curves_[strings_[string_of_[vertex]].curve]; }
  [[nodiscard]] std::size_t near_of(Index vertex) const { return strings_[string_of_[vertex]].near[index_on_[vertex]]; }
  [[nodiscard]] Member beside(Index vertex, bool after) const;
  [[nodiscard]] static std::pair<Index, Index> ends_of(const Curve& curve, std::size_t segment) {
    return {curve.points[segment], curve.points[(segment + 1) % curve.points.size()]};
  }
  [[nodiscard]] Vec3 point(const Curve& curve, std::size_t i) const { return points_[curve.points[i % curve.points.size()]]; }
  [[nodiscard]] double place_near(const Curve& curve, std::size_t segment, Vec3 position, double& distance) const;
  [[nodiscard]] std::optional<double> place_on(const Curve& curve, std::size_t segment, Vec3 position) const;
  [[nodiscard]] std::optional<double> place_of(const Curve& curve, std::size_t near, Vec3 position) const;
  [[nodiscard]] static std::size_t segment_at(const Curve& curve, double place);

  std::span<const Vec3> points_;  // positions of the mesh that vertices slide along
  Plane plane_;
  bool single_precision_ = false;
  double beside_ = 0.0;  // greatest distance of a vertex from its curve, in mesh units; 0: none but for rounding
  std::vector<Curve> curves_;
  std::vector<String> strings_;
  std::vector<Index> string_of_;  // by vertex, its string; kNoIndex: it does not slide
  std::vector<Index> index_on_;   // by vertex that slides, its index on its string
};

}  // namespace dmoscope
