#pragma once
// Metrics of atoms, for any scalar: a metric that is smooth on a whole element or corner has its own formula, any other the smooth pieces
// of which it is the least.

#include "core/mesh/plane.h"
#include "core/quality/formulas.h"

namespace dmoscope::pieces {

using formulas::RealOf;

/// First vertex of a piece, from which its edges lead.
template <class V>
[[nodiscard]] V origin(V /*edge*/) {
  return V{};
}
template <class R>
[[nodiscard]] SurfaceVectorOf<R> origin(SurfaceVectorOf<R> edge) {
  return {{}, edge.normal};
}

/// Part of a simplex that a piece belongs to: the whole, or, where a metric has a kink, one of its corners or edges.
enum class Of { Whole, Corner, Edge };

/// Smooth piece of a metric. triangle(u, v), tetrahedron(u, v, w): edges from the first vertex to the others; the corner is the first
/// vertex, the edge is u. Only for simplices that are not inverted.
template <Metric M>
struct Piece {
  static constexpr Of kTriangle = Of::Whole, kTetrahedron = Of::Whole;
  template <class V>
  static RealOf<V> triangle(V u, V v) {
    return formulas::metric<M>(formulas::Triangle<V>(origin(u), u, v));
  }
  template <class V>
  static RealOf<V> tetrahedron(V u, V v, V w) {
    return formulas::metric<M>(formulas::Tetrahedron<V>(V{}, u, v, w));
  }
};

template <>
struct Piece<Metric::MinAngle> {
  static constexpr Of kTriangle = Of::Corner, kTetrahedron = Of::Edge;
  template <class V>
  static RealOf<V> triangle(V u, V v) {
    return scalar::constant<RealOf<V>>(3.0 / formulas::pi) * formulas::angle<V>(cross(u, v), u, v);
  }
  template <class V>
  static RealOf<V> tetrahedron(V u, V v, V w) {
    using scalar::atan2;
    using scalar::sqrt;
    const RealOf<V> sine = sqrt(dot(u, u)) * formulas::determinant(u, v, w);
    return scalar::constant<RealOf<V>>(1.0 / formulas::Formula<Metric::MinAngle>::kRegular) * atan2(sine, dot(cross(u, v), cross(u, w)));
  }
};

template <>
struct Piece<Metric::MaxAngle> {
  static constexpr Of kTriangle = Of::Corner, kTetrahedron = Of::Whole;
  template <class V>
  static RealOf<V> triangle(V u, V v) {
    return scalar::constant<RealOf<V>>(1.5 / formulas::pi) * formulas::angle<V>(cross(u, v), u, V{} - v);
  }
};

template <>
struct Piece<Metric::ScaledJacobian> {
  static constexpr Of kTriangle = Of::Corner, kTetrahedron = Of::Corner;
  template <class V>
  static RealOf<V> triangle(V u, V v) {
    using scalar::sqrt;
    return scalar::constant<RealOf<V>>(2.0 / formulas::sqrt3) * cross(u, v) / sqrt(dot(u, u) * dot(v, v));
  }
  template <class V>
  static RealOf<V> tetrahedron(V u, V v, V w) {
    using scalar::sqrt;
    const RealOf<V> product = sqrt(dot(u, u)) * sqrt(dot(v, v)) * sqrt(dot(w, w));
    return scalar::constant<RealOf<V>>(std::numbers::sqrt2) * formulas::determinant(u, v, w) / product;
  }
};

template <>
struct Piece<Metric::AspectRatio> {
  static constexpr Of kTriangle = Of::Edge, kTetrahedron = Of::Edge;
  template <class V>
  static RealOf<V> triangle(V u, V v) {
    using scalar::sqrt;
    const V w = v - u;
    const RealOf<V> longest = sqrt(dot(u, u));
    return scalar::constant<RealOf<V>>(2.0 * formulas::sqrt3) * cross(u, v) / (longest * (longest + sqrt(dot(v, v)) + sqrt(dot(w, w))));
  }
  template <class V>
  static RealOf<V> tetrahedron(V u, V v, V w) {
    using scalar::sqrt;
    const formulas::Tetrahedron<V> t(V{}, u, v, w);
    return scalar::constant<RealOf<V>>(2.0 * std::numbers::sqrt2 * formulas::sqrt3) * t.six_volume /
           (formulas::twice_surface(t) * sqrt(dot(u, u)));
  }
};

/// Quality of a quadrilateral's corner between the edges u and v, counter-clockwise, or of a corner of a volume element that is no
/// tetrahedron.
template <Metric M, class V>
[[nodiscard]] RealOf<V> square_corner(V u, V v) {
  using R = RealOf<V>;
  using scalar::sqrt;
  if constexpr (M == Metric::ScaledJacobian)
    return cross(u, v) / sqrt(dot(u, u) * dot(v, v));
  else if constexpr (M == Metric::MeanRatio)
    return R(2) * cross(u, v) / (dot(u, u) + dot(v, v));
  else
    return R(0);
}
template <Metric M, class Ideal, class V>
[[nodiscard]] RealOf<V> solid_corner(V u, V v, V w) {
  return formulas::Formula<M>::template corner<Ideal>(u, v, w, formulas::determinant(u, v, w));
}

}  // namespace dmoscope::pieces
