#pragma once
// Exact deviation of a mesh's faces from the surface of the input, by laying each over the facets beneath it.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "core/mesh/position_view.h"
#include "core/reference/domain.h"

namespace dmoscope {

/// Fit of a triangle over the facets beneath it. The greatest distance between them is at the triangle's corners, at the facets' corners,
/// or where their edges cross. Distances are measured along the triangle's normal, so none is shorter than that to the surface.
/// Quadrilaterals count as split by their shorter diagonals, as facets are.
struct Fit {
  double deviation = 0.0;     // greatest distance, in mesh units; infinite if the facets beneath do not cover the triangle
  double other_split = 0.0;   // greatest distance with quadrilaterals split by their longer diagonals: a measure of their warping
  double least_cosine = 1.0;  // least cosine of the angles between the triangle and the facets beneath
};
/// Whether a fit is as good as another in every respect.
[[nodiscard]] inline bool is_within(const Fit& fit, const Fit& other) {
  return fit.deviation <= other.deviation && fit.other_split <= other.other_split && fit.least_cosine >= other.least_cosine;
}
/// The worse of the two in every respect.
[[nodiscard]] inline Fit worse(const Fit& a, const Fit& b) {
  return {std::max(a.deviation, b.deviation), std::max(a.other_split, b.other_split), std::min(a.least_cosine, b.least_cosine)};
}
inline constexpr Fit kNoFit{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), -1.0};

/// Working memory of overlays, kept from one to the next.
struct OverlayRoom {
  struct Corner {
    Vec2<double> at;
    double height;
    std::array<double, 3> inside;  // signed distances from the triangle's edges, positive inside
  };
  struct Crossed {  // a facet that was reached, and the side through which
    std::size_t from;
    std::array<Corner, 3> corners;
    double area;  // twice the area of its projection onto the triangle's plane
  };
  std::vector<Index> found, starts;  // found: facets that were reached
  std::vector<Crossed> crossed;      // one for each facet found, or more
  std::vector<Corner> polygon, clipped;
  std::vector<Curves::Stretch> stretches;
};

/// Lays faces over facets. Domain and room must outlive it.
class Overlay {
 public:
  Overlay(const Domain& domain, OverlayRoom& room) : domain_(domain), faces_(domain.faces()), facets_(faces_.facets()), room_(room) {}

  /// Fit of the faces at a vertex, with it at `target`. `beneath`: facet beneath that place for a vertex on a surface; null for one on a
  /// curve. Ends at the first face that is not `within`, and then the result is not within it, either.
  [[nodiscard]] Fit star(PositionView positions, Index vertex, Vec3 target, const FacetPlace* beneath, const Fit& within);
  /// Whether faces of a star that lie over facets keep doing so, for stars with faces that do not, such as those that are turned away: with
  /// the vertex at `target`, every face must lie over facets that does with it at `here`, and each face that does must be within the bound,
  /// or as near as the farthest of those is. `here_beneath`, `beneath`: see star().
  [[nodiscard]] bool keeps_what_lies(PositionView positions, Index vertex, Vec3 here, const FacetPlace* here_beneath, Vec3 target,
                                     const FacetPlace* beneath, const Fit& bound);
  /// Fit of a triangle whose corners are on a patch. `from`: a facet near it. `allowed`: stretches of curves along its edges, across which
  /// it may reach.
  [[nodiscard]] Fit triangle(const std::array<Vec3, 3>& corners, Index from, std::span<const Curves::Stretch> allowed);

 private:
  using Corner = OverlayRoom::Corner;
  struct Ground;
  struct Sketch;
  using Crossed = OverlayRoom::Crossed;
  /// Precision needed of a deviation: one below `enough` may be returned too small, and one beyond `limit` may be any value beyond it.
  struct Need {
    double enough = 0.0, limit = kNoFit.deviation;
  };
  /// A face with its vertex at `target`.
  struct Face {
    PositionView positions;
    Index face, vertex;
    Vec3 target;
    const FacetPlace* beneath;
    const Need& need;
  };
  [[nodiscard]] bool sketch(PositionView positions, Index vertex, Vec3 target, const FacetPlace& beneath, double limit, Sketch& out) const;
  [[nodiscard]] Fit face(const Face& face);
  [[nodiscard]] Fit triangle_of(const Face& face, const std::array<Vec3, 3>& corners);
  void find_starts(const Face& face);
  void find_stretches(const Face& face);
  template <class Allowed>
  [[nodiscard]] Fit triangle(const std::array<Vec3, 3>& corners, Index from, const Need& need, const Allowed& allowed);
  [[nodiscard]] static std::optional<Ground> ground_of(const std::array<Vec3, 3>& corners);
  [[nodiscard]] std::optional<FacetPlace> beneath_centre(const Ground& ground, Index from) const;
  struct Laid {
    Fit fit;
    double covered = 0.0;  // twice the covered area
    bool beyond = false;   // whether the triangle reaches across one of the stretches
  };
  [[nodiscard]] std::optional<Fit> lay_quickly(const Ground& ground, Index start, const Need& need);
  [[nodiscard]] bool cross_sides(const Ground& ground, std::size_t k, Fit& fit);
  [[nodiscard]] Crossed& room_for(std::size_t k);
  void reach(const Ground& ground, Index across, std::size_t through, std::size_t side);
  [[nodiscard]] double deviation_at_corners(const Ground& ground) const;
  [[nodiscard]] bool lay(const Ground& ground, Index facet, std::span<const Curves::Stretch> allowed, Laid& laid);
  void clip(std::size_t edge);

  const Domain& domain_;
  const SlidingFaces& faces_;
  const Facets& facets_;
  OverlayRoom& room_;
};

}  // namespace dmoscope
