#pragma once
// The star of a vertex of a curved surface: offsets in space, each element judged in its own plane.

#include <vector>

#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/quality/formulas.h"
#include "core/search/star.h"

namespace dmoscope {

/// The unit vector of a x b, or `fallback` if that is 0. Real: double, or a pack of it whose slots get the bits that a double gets.
template <class Real>
[[nodiscard]] Vec3Of<Real> unit_normal_of(Vec3Of<Real> a, Vec3Of<Real> b, Vec3 fallback) {
  using scalar::select, scalar::sqrt;
  const Vec3Of<Real> n = cross(a, b), other = point_of<Real>(fallback);
  const Real length = sqrt(dot(n, n));
  const auto has_one = length > Real(0);
  const Vec3Of<Real> unit = (Real(1) / select(has_one, length, Real(1))) * n;
  return {select(has_one, unit.x, other.x), select(has_one, unit.y, other.y), select(has_one, unit.z, other.z)};
}

/// The normal of curved_normal(), for double or packs of it.
template <class Real>
[[nodiscard]] Vec3Of<Real> curved_normal_of(Vec3Of<Real> a, Vec3Of<Real> b, Vec3 frame_normal, bool against) {
  using scalar::select;
  const Vec3Of<Real> n = unit_normal_of<Real>(a, b, frame_normal);
  if (!against) return n;
  const Vec3Of<Real> above = point_of<Real>(frame_normal);
  const auto looks_away = dot(n, above) < Real(0);
  return {select(looks_away, above.x, n.x), select(looks_away, above.y, n.y), select(looks_away, above.z, n.z)};
}

/// An incident triangle: its other two corners in the element's order, and its reference measure for untangling.
struct SurfaceTriangle {
  static constexpr Index kMoving = 0;
  Vec3 b, c;
  double reference;
  Vec3 fallback;         // normal of an element that is shrunk to a line
  bool against = false;  // see Curved
  template <class Real>
  [[nodiscard, gnu::always_inline]] formulas::Triangle<SurfaceVectorOf<Real>> with(SurfaceVectorOf<Real> p) const {
    const Vec3Of<Real> to_b = point_of<Real>(b), to_c = point_of<Real>(c),
                       n = curved_normal_of<Real>(to_b - p.v, to_c - p.v, fallback, against);
    return {{p.v, n}, {to_b, n}, {to_c, n}};
  }
};
/// An incident quadrilateral: its other three corners in the element's order.
struct SurfaceQuadrilateral {
  static constexpr Index kMoving = 0;
  Vec3 b, c, d;
  double reference;
  Vec3 fallback;
  bool is_fixed;         // whether the normal is `normal` for any shape: see Curved
  bool against = false;  // see Curved
  template <class Real>
  [[nodiscard]] formulas::Quadrilateral<SurfaceVectorOf<Real>> with(SurfaceVectorOf<Real> p) const {
    const Vec3Of<Real> to_b = point_of<Real>(b), to_c = point_of<Real>(c), to_d = point_of<Real>(d);
    const Vec3Of<Real> n = is_fixed ? point_of<Real>(fallback) : curved_normal_of<Real>(to_c - p.v, to_d - to_b, fallback, against);
    return {{p.v, n}, {to_b, n}, {to_c, n}, {to_d, n}};
  }
};

/// The star of a vertex of a surface, in units of `scale`, its largest offset.
struct SurfaceStar {
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceQuadrilateral> quadrilaterals;
  double scale = 1.0;
};

/// A view of a SurfaceStar, see StarView.
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

/// The lists of a SurfaceStar, see PlanarLists.
struct SurfaceLists {
  ListView<SurfaceTriangle> simplices;
  ListView<SurfaceQuadrilateral> quadrilaterals;
  template <class F>
  void for_others(F f) const {
    for (std::size_t i = 0; i < quadrilaterals.size; ++i) f(quadrilaterals.data[i]);
  }
};
[[nodiscard]] inline SurfaceLists lists_of(const SurfaceStar& star) { return {list_of(star.triangles), list_of(star.quadrilaterals)}; }

/// Gathers the star into `out`, whose vectors are reused.
void gather_star(const MeshView<Curved>& mesh, PositionView positions, Index vertex, SurfaceStar& out);

}  // namespace dmoscope
