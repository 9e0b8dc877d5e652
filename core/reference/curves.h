#pragma once
// The boundary and the interfaces of the input as curves along which vertices slide: polylines that no vertex ever leaves.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/standing.h"

namespace dmoscope {

/// Places on a curve are lengths along it, in mesh units, from its first point; those of a closed curve without a corner start anew after
/// its length. A vertex's place follows from its position: it is where its curve passes through that, and of several passes the one nearest
/// to where the vertex was in the input. The mesh must outlive them.
class Curves {
 public:
  /// A vertex of the boundary, or of an interface between materials, slides where the rule lets these, unless
  /// - it has other than two edges of them, or an edge with more than two elements;
  /// - they turn there by more than the corner angle, or have no direction;
  /// - the file gives it a meaning: it is a named point, an end of a string or line that the file names, a corner of a required element,
  /// or,
  ///   unless interfaces are free, the end of an interface or of a named line inside.
  Curves(const InputMesh& input, const StandingRule& rule);

  [[nodiscard]] bool slides(Index vertex) const noexcept { return curve_of_[vertex] != kNoIndex; }
  [[nodiscard]] Index count() const noexcept { return sliding_; }        // of vertices that slide
  [[nodiscard]] Index count_inside() const noexcept { return inside_; }  // of these, off the boundary
  [[nodiscard]] Index corners() const noexcept { return corners_; }      // of the boundary's others, where it slides
  /// "122 vertices slide along the boundary, and 34 of its vertices stay; 36 vertices slide along interfaces".
  [[nodiscard]] std::string sentence() const;
  [[nodiscard]] Index curve_count() const noexcept { return static_cast<Index>(curves_.size()); }

  /// Where on its curve a vertex that slides stands; nowhere for one that was put beside it.
  [[nodiscard]] std::optional<double> place(Index vertex, Vec3 position) const;
  /// The point at a place of the vertex's curve.
  [[nodiscard]] Vec3 at(Index vertex, double place) const;

  /// The neighbours of a vertex along its curve, and where they stand beside its place. Sliding never leads past them.
  struct Neighbours {
    Index before, after;
    double place_before, place_after;  // of a closed curve: less than its length away from `place`
  };
  /// None where a neighbour stands beside the curve, or not on its side.
  [[nodiscard]] std::optional<Neighbours> neighbours(Index vertex, double place, PositionView positions) const;

  /// How far an edge is from the stretch of the curve that it stands for, exactly and both ways: the greatest distance of the curve's
  /// points between two places, first <= last, from the segment between the positions there.
  [[nodiscard]] double deviation(Index vertex, double first, double last, Vec3 from, Vec3 to) const;

 private:
  struct Curve {
    std::vector<Index> vertices;  // along it; of a closed one without a corner each once
    std::vector<double> lengths;  // from the first point to each; of a closed one, to the first again, too
    bool closed = false;
    [[nodiscard]] std::size_t segments() const { return lengths.size() - 1; }
    [[nodiscard]] double length() const { return lengths.back(); }
  };
  class Builder;

  [[nodiscard]] Vec3 point(const Curve& curve, std::size_t i) const { return points_[curve.vertices[i % curve.vertices.size()]]; }
  [[nodiscard]] std::optional<double> place_on(const Curve& curve, std::size_t segment, Vec3 position) const;
  [[nodiscard]] std::optional<double> place_of(const Curve& curve, std::size_t index, Vec3 position) const;
  [[nodiscard]] static std::size_t segment_at(const Curve& curve, double place);

  std::span<const Vec3> points_;  // of the input
  Plane plane_;
  bool single_precision_ = false;
  std::vector<Curve> curves_;
  std::vector<Index> curve_of_;  // of every vertex; kNoIndex: it does not slide
  std::vector<Index> index_on_;  // where on its curve a vertex that slides is
  Index sliding_ = 0, inside_ = 0, corners_ = 0;
};

}  // namespace dmoscope
