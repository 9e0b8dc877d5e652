#pragma once
// The star of a vertex of a curved surface: offsets in space, each element judged in its own plane.

#include <vector>

#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/quality/element_shape.h"

namespace dmoscope {

/// An incident triangle: its other two corners in the element's order, and its reference measure for untangling.
struct SurfaceTriangle {
  static constexpr Index kMoving = 0;
  Vec3 b, c;
  double reference;
  Vec3 fallback;  // the normal of one that is shrunk to a line
  [[nodiscard, gnu::always_inline]] formulas::Triangle<SurfaceVector> with(SurfaceVector p) const {
    const Vec3 n = unit_normal(b - p.v, c - p.v, fallback);
    return {{p.v, n}, {b, n}, {c, n}};
  }
};
/// An incident quadrilateral: its other three corners in the element's order.
struct SurfaceQuadrilateral {
  static constexpr Index kMoving = 0;
  Vec3 b, c, d;
  double reference;
  Vec3 fallback;
  bool is_fixed;  // the normal, whatever the shape: see Curved
  [[nodiscard]] formulas::Quadrilateral<SurfaceVector> with(SurfaceVector p) const {
    const Vec3 n = is_fixed ? fallback : unit_normal(c - p.v, d - b, fallback);
    return {{p.v, n}, {b, n}, {c, n}, {d, n}};
  }
};

/// In units of `scale`, its largest offset.
struct SurfaceStar {
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceQuadrilateral> quadrilaterals;
  double scale = 1.0;
};

/// A view of one: see StarView.
class SurfaceStarView {
 public:
  SurfaceStarView(const SurfaceStar& star) : star_(&star) {}  // NOLINT(google-explicit-constructor): a view of it
  template <bool Quadrilaterals, class F>
  void for_each(F f) const {
    for (const SurfaceTriangle& t : star_->triangles) f(t);
    if constexpr (Quadrilaterals)
      for (const SurfaceQuadrilateral& q : star_->quadrilaterals) f(q);
  }

 private:
  const SurfaceStar* star_;
};

/// Fills `out`, whose vectors are reused.
void gather_star(const MeshView<Curved>& mesh, PositionView positions, Index vertex, SurfaceStar& out);

}  // namespace dmoscope
