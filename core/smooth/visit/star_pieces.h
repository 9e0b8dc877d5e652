#pragma once
// Smooth functions of which the quality of a star is the least: one per triangle or tetrahedron, one per corner of any other element.

#include <type_traits>
#include <vector>

#include "core/numeric/dual.h"
#include "core/quality/formulas.h"
#include "core/search/star.h"
#include "core/search/surface_star.h"

namespace dmoscope {

/// Piece with the star's vertex at some offset, and its gradient, per unit of the star's scale. Frame: Plane, Space or Curved.
template <class Frame>
using StarGradient = std::conditional_t<std::is_same_v<Frame, Plane>, Vec2<double>, Vec3>;
template <class Frame>
struct StarPiece {
  double value = 0.0;
  StarGradient<Frame> gradient{};
};

namespace star_pieces {

/// Calls f with the vertex and its two neighbours of every corner of a quadrilateral, `p` the vertex of the star: the corner there, those
/// beside it, and the one across.
template <class R, class F>
constexpr void for_corners(const StarQuadrilateral<double>& q, Vec2<R> p, const F& f) {
  const Vec2<R> b = point_of<R>(q.b), c = point_of<R>(q.c), d = point_of<R>(q.d);
  f(p, b, d);
  f(b, c, p);
  f(c, d, b);
  f(d, p, c);
}

/// Calls f.template operator()<Ideal>(u, v, w, their determinant) with the edges of every corner that changes when `moving` moves.
template <class V, class Ideal, std::size_t N, class Corners, class F>
constexpr void for_moving_corners(const formulas::CorneredSolid<V, Ideal, N, Corners>& element, Index moving, const F& f) {
  (void)element.least_around(moving, [&f](V u, V v, V w, formulas::RealOf<V> jacobian) {
    f.template operator()<Ideal>(u, v, w, jacobian);
    return jacobian;
  });
}

/// Calls tetrahedron(formulas::Tetrahedron, reference measure) for each tetrahedron of a volume's star with its vertex at `p` and, unless
/// told to leave them out, corner.template operator()<Ideal>(u, v, w, their determinant, reference measure) for each corner of the other
/// volume elements that changes with the vertex's place; the other corners say nothing about where it should be.
template <bool Others, class R, class Take, class TakeCorner>
constexpr void for_solids(const VolumeStar<double>& star, Vec3Of<R> p, const Take& tetrahedron, const TakeCorner& corner) {
  using V = Vec3Of<R>;
  VolumeStarView<double>(star).for_each<Others>([&]<class Element>(const Element& element) {
    if constexpr (std::is_same_v<Element, StarTetrahedron<double>>) {
      tetrahedron(element.with(p), element.reference);
    } else {
      for_moving_corners(element.with(p), element.kMoving, [&]<class Ideal>(V u, V v, V w, R jacobian) {
        corner.template operator()<Ideal>(u, v, w, jacobian, element.reference);
      });
    }
  });
}

}  // namespace star_pieces

/// Calls f with the metric of each triangle and of each corner of the quadrilaterals, with the star's vertex at `p`; for a metric that is
/// not the least of its corners, with that of the whole quadrilateral. R: the scalar, such as double or Dual.
template <Metric M, class R, class F>
constexpr void for_qualities(const Star<double>& star, Vec2<R> p, const F& f) {
  using V = Vec2<R>;
  for (const StarTriangle<double>& t : star.triangles) f(formulas::metric<M>(t.with(p)));
  if constexpr (formulas::kDefinedForQuadrilaterals<M, V>) {
    for (const StarQuadrilateral<double>& q : star.quadrilaterals) {
      if constexpr (formulas::Formula<M>::kSeesInversion) {
        // Evaluates a corner as the parallelogram made of it, all of whose corners are alike.
        star_pieces::for_corners(q, p, [&f](V corner, V next, V before) {
          f(formulas::metric<M>(formulas::Quadrilateral<V>(corner, next, next + before - corner, before)));
        });
      } else {
        f(formulas::metric<M>(q.with(p)));
      }
    }
  }
}

/// Calls f with every corner's Jacobian over its element's reference measure.
template <class R, class F>
constexpr void for_jacobians(const Star<double>& star, Vec2<R> p, const F& f) {
  using V = Vec2<R>;
  for (const StarTriangle<double>& t : star.triangles) f(cross(point_of<R>(t.b) - p, point_of<R>(t.c) - p) / R(t.reference));
  for (const StarQuadrilateral<double>& q : star.quadrilaterals)
    star_pieces::for_corners(q, p, [&](V corner, V next, V before) { f(cross(next - corner, before - corner) / R(q.reference)); });
}

/// Calls f with the metric of each tetrahedron and of each corner of a volume's other elements that changes with the vertex's place.
template <Metric M, class R, class F>
constexpr void for_qualities(const VolumeStar<double>& star, Vec3Of<R> p, const F& f) {
  using V = Vec3Of<R>;
  star_pieces::for_solids<formulas::kDefinedForCorners<M>>(
      star, p, [&](const formulas::Tetrahedron<V>& t, double /*reference*/) { f(formulas::metric<M>(t)); },
      [&]<class Ideal>(V u, V v, V w, R jacobian, double /*reference*/) {
        if constexpr (formulas::kDefinedForCorners<M>) f(formulas::Formula<M>::template corner<Ideal>(u, v, w, jacobian));
      });
}
template <class R, class F>
constexpr void for_jacobians(const VolumeStar<double>& star, Vec3Of<R> p, const F& f) {
  using V = Vec3Of<R>;
  star_pieces::for_solids<true>(
      star, p, [&f](const formulas::Tetrahedron<V>& t, double reference) { f(t.six_volume / R(reference)); },
      [&f]<class Ideal>(V /*u*/, V /*v*/, V /*w*/, R jacobian, double reference) { f(jacobian / R(reference)); });
}

/// Calls f(star, plane) with each element of a surface's star alone in its own plane as it is with the star's vertex at `p`, which is the
/// origin there. The metric of such an element does not change to first order as its vertex leaves the plane.
template <class F>
void for_flat_elements(const SurfaceStar& star, Vec3 p, const F& f) {
  thread_local Star<double> flat;  // kept: a visit allocates nothing
  const SurfaceVector at{p, {}};
  flat.quadrilaterals.clear();
  for (const SurfaceTriangle& t : star.triangles) {
    const Plane plane = tangent_plane(t.with(at).ab.normal);
    flat.triangles.assign(1, {plane.project(t.b - p), plane.project(t.c - p), t.reference});
    f(flat, plane);
  }
  flat.triangles.clear();
  for (const SurfaceQuadrilateral& q : star.quadrilaterals) {
    const Plane plane = tangent_plane(q.with(at).edge[0].normal);
    flat.quadrilaterals.assign(1, {plane.project(q.b - p), plane.project(q.c - p), plane.project(q.d - p), q.reference});
    f(flat, plane);
  }
}

/// Appends the pieces of a metric, and every corner's Jacobian over its element's reference measure. Star: Star<double>, VolumeStar<double>
/// or SurfaceStar.
template <Metric M, class Frame, class StarT>
void append_pieces(const StarT& star, OffsetIn<Frame, double> p, std::vector<StarPiece<Frame>>& out) {
  if constexpr (std::is_same_v<Frame, Curved>)
    for_flat_elements(star, p.v, [&out](const Star<double>& flat, const Plane& plane) {
      for_qualities<M>(flat, variable(Vec2<double>{}), [&](const Dual& q) { out.push_back({q.value, plane.lift(q.by)}); });
    });
  else
    for_qualities<M>(star, variable(p), [&out](const auto& q) { out.push_back({q.value, q.by}); });
}
template <class Frame, class StarT>
void append_jacobians(const StarT& star, OffsetIn<Frame, double> p, std::vector<StarPiece<Frame>>& out) {
  if constexpr (std::is_same_v<Frame, Curved>)
    for_flat_elements(star, p.v, [&out](const Star<double>& flat, const Plane& plane) {
      for_jacobians(flat, variable(Vec2<double>{}), [&](const Dual& j) { out.push_back({j.value, plane.lift(j.by)}); });
    });
  else
    for_jacobians(star, variable(p), [&out](const auto& j) { out.push_back({j.value, j.by}); });
}

}  // namespace dmoscope
