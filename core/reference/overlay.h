#pragma once
// How near the faces of a mesh stay to the surface of the input: exactly, by laying each over the facets beneath it.

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "core/mesh/position_view.h"
#include "core/reference/domain.h"

namespace dmoscope {

/// Where the greatest distance between a triangle and the facets beneath it stands, both are known: at its corners, at theirs, and where
/// its edges cross theirs. Distances are taken straight along the triangle's normal, so none is shorter than that to the surface.
/// Quadrilaterals count as split by their shorter diagonals, as facets are.
struct Fit {
  double deviation = 0.0;     // the greatest distance, in mesh units; infinite where the facets beneath do not cover it all
  double other_split = 0.0;   // the same of quadrilaterals split by their longer diagonals: as far as they are warped
  double least_cosine = 1.0;  // of the angles between it and the facets beneath
};
/// Is a fit as good as another everywhere?
[[nodiscard]] inline bool is_within(const Fit& fit, const Fit& other) {
  return fit.deviation <= other.deviation && fit.other_split <= other.other_split && fit.least_cosine >= other.least_cosine;
}
inline constexpr Fit kNoFit{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), -1.0};

/// What an overlay works in, kept from one to the next.
struct OverlayRoom {
  struct Crossed {  // a facet, and the side through which it was reached
    Index facet;
    std::size_t from;
  };
  struct Corner {
    Vec2<double> at;
    double height;
    std::array<double, 3> inside;  // distances from the triangle's edges, positive inside
  };
  std::vector<Index> found, starts;
  std::vector<Crossed> crossed;
  std::vector<Corner> polygon, clipped;
  std::vector<Curves::Stretch> stretches;
};

/// Domain and room must outlive it.
class Overlay {
 public:
  Overlay(const Domain& domain, OverlayRoom& room) : domain_(domain), facets_(domain.facets()), room_(room) {}

  /// The faces at a vertex, with it at `target`. `beneath`: where that is, of a vertex on a surface; of one on a curve nothing. The first
  /// face that is not `within` ends it: the result is not, either.
  [[nodiscard]] Fit star(PositionView positions, Index vertex, Vec3 target, const FacetPlace* beneath, const Fit& within);
  /// A triangle, whose corners stand on a patch. `from`: a facet near it. `allowed`: stretches of curves along its edges; what of it lies
  /// beyond these is near the curve.
  [[nodiscard]] Fit triangle(const std::array<Vec3, 3>& corners, Index from, std::span<const Curves::Stretch> allowed);

 private:
  using Corner = OverlayRoom::Corner;
  struct Ground;
  [[nodiscard]] Fit face(PositionView positions, Index face, Index vertex, Vec3 target);
  void find_starts(Index vertex, Vec3 target, Index face, const FacetPlace* beneath);
  void find_stretches(PositionView positions, Index face, Index vertex, Vec3 target);
  struct Laid {
    Fit fit;
    double covered = 0.0;  // twice the area
    bool beyond = false;   // the triangle reaches across one of the stretches
  };
  [[nodiscard]] std::optional<Fit> lay_quickly(const Ground& ground, Index start);
  [[nodiscard]] bool lay(const Ground& ground, Index facet, std::span<const Curves::Stretch> allowed, Laid& laid);
  /// As shares of the way from one corner to the other.
  struct Part {
    double first, last;
  };
  [[nodiscard]] static std::optional<Part> part_inside(const Corner& from, const Corner& to, double margin);
  void clip(std::size_t edge);

  const Domain& domain_;
  const Facets& facets_;
  OverlayRoom& room_;
};

}  // namespace dmoscope
