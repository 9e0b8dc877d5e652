#pragma once
// The smooth functions of which the quality of a star is the least: one a triangle, one a corner of a quadrilateral.

#include "core/quality/formulas.h"
#include "core/search/star.h"

namespace dmoscope {

namespace star_pieces {

template <class R>
[[nodiscard]] constexpr Vec2<R> as(Vec2<double> p) {
  return {R(p.x), R(p.y)};
}

/// Calls f with the vertex and its two neighbours of every corner of a quadrilateral, `p` the vertex of the star: the corner there, those
/// beside it, and the one across.
template <class R, class F>
constexpr void for_corners(const StarQuadrilateral<double>& q, Vec2<R> p, const F& f) {
  const Vec2<R> b = as<R>(q.b), c = as<R>(q.c), d = as<R>(q.d);
  f(p, b, d);
  f(b, c, p);
  f(c, d, b);
  f(d, p, c);
}

}  // namespace star_pieces

/// Calls f with the metric of each triangle and of each corner of the quadrilaterals, with the star's vertex at `p`; of a metric that is
/// not the least of its corners, with that of the whole quadrilateral. R: the scalar, such as double or Dual.
template <Metric M, class R, class F>
constexpr void for_qualities(const Star<double>& star, Vec2<R> p, const F& f) {
  using V = Vec2<R>;
  using star_pieces::as;
  for (const StarTriangle<double>& t : star.triangles) f(formulas::metric<M>(formulas::Triangle<V>(p, as<R>(t.b), as<R>(t.c))));
  if constexpr (formulas::kDefinedForQuadrilaterals<M, V>) {
    for (const StarQuadrilateral<double>& q : star.quadrilaterals) {
      if constexpr (formulas::Formula<M>::kSeesInversion) {
        // All corners of a parallelogram are as good as the one that it is made of.
        star_pieces::for_corners(q, p, [&f](V corner, V next, V before) {
          f(formulas::metric<M>(formulas::Quadrilateral<V>(corner, next, next + before - corner, before)));
        });
      } else {
        f(formulas::metric<M>(formulas::Quadrilateral<V>(p, as<R>(q.b), as<R>(q.c), as<R>(q.d))));
      }
    }
  }
}

/// Calls f with every corner's Jacobian over its element's reference measure.
template <class R, class F>
constexpr void for_jacobians(const Star<double>& star, Vec2<R> p, const F& f) {
  using V = Vec2<R>;
  using star_pieces::as;
  for (const StarTriangle<double>& t : star.triangles) f(cross(as<R>(t.b) - p, as<R>(t.c) - p) / R(t.reference));
  for (const StarQuadrilateral<double>& q : star.quadrilaterals)
    star_pieces::for_corners(q, p, [&](V corner, V next, V before) { f(cross(next - corner, before - corner) / R(q.reference)); });
}

}  // namespace dmoscope
