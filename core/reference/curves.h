#pragma once
// Curves of the input along which vertices slide, its boundary and interfaces or the feature edges of its surface: polylines that no
// vertex ever leaves.

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"

namespace dmoscope {

/// Places on a curve are lengths along it, in mesh units, from its first point; those of a closed curve without a corner start anew after
/// its length. A vertex's place follows from its position: it is where its curve passes through that, and of several passes the one nearest
/// to where the vertex was in the input. The mesh must outlive them.
class Curves {
 public:
  /// `ends`: who slides, and between whom.
  Curves(const InputMesh& input, const CurveEnds& ends);

  [[nodiscard]] bool slides(Index vertex) const noexcept { return curve_of_[vertex] != kNoIndex; }
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

  /// Segments of a curve, from the first to the last; of a closed curve `first` may be greater than `last`.
  struct Stretch {
    Index curve;
    std::size_t first, last;
    [[nodiscard]] bool holds(std::size_t segment) const noexcept {
      return first <= last ? first <= segment && segment <= last : segment >= first || segment <= last;
    }
  };
  /// What lies between a vertex that slides and a neighbour along the curve; none where `other` is no neighbour, or either beside the
  /// curve.
  [[nodiscard]] std::optional<Stretch> stretch_to(Index vertex, Vec3 position, Index other, Vec3 position_of_other) const;
  /// The edges of the input around a place of the vertex's curve: the one it lies on, and the one before where it is that one's first end.
  /// kNoIndex: none.
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

 private:
  struct Curve {
    std::vector<Index> vertices;  // along it; of a closed one without a corner each once
    std::vector<double> lengths;  // from the first point to each; of a closed one, to the first again, too
    bool closed = false;
    [[nodiscard]] std::size_t segments() const { return lengths.size() - 1; }
    [[nodiscard]] double length() const { return lengths.back(); }
  };
  class Builder;

  [[nodiscard]] static std::pair<Index, Index> ends_of(const Curve& curve, std::size_t segment) {
    return {curve.vertices[segment], curve.vertices[(segment + 1) % curve.vertices.size()]};
  }
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
};

}  // namespace dmoscope
