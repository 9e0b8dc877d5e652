#pragma once
// The shapes of planar elements as metrics see them, for any scalar and any vector type V that offers operator-, dot(V, V) and a signed
// cross(V, V): points of the plane in double (statistics), in float or packs of float (search), vectors of a curved surface.
//
// Corners run counter-clockwise.

#include <cmath>
#include <numbers>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/numeric/scalar.h"
#include "core/quality/metrics/metric_info.h"

namespace dmoscope::formulas {

template <class V>
using RealOf = decltype(dot(V{}, V{}));

using std::numbers::pi;
using std::numbers::sqrt3;

using scalar::abs;
using scalar::atan2;
using scalar::max;
using scalar::min;
using scalar::select;
using scalar::sqrt;

/// Edge vectors and twice the signed area of the triangle a, b, c.
template <class V>
struct Triangle {
  V ab, bc, ca;
  RealOf<V> twice_area;
  DMOSCOPE_ANYWHERE Triangle(V a, V b, V c) : ab(b - a), bc(c - b), ca(a - c), twice_area(cross(b - a, c - a)) {}
};

/// Edge vectors and the corner Jacobians a_i (cross product of the edges that leave corner i) of the quadrilateral a, b, c, d.
template <class V>
struct Quadrilateral {
  using R = RealOf<V>;
  V edge[4];
  R jacobian[4];
  DMOSCOPE_ANYWHERE Quadrilateral(V a, V b, V c, V d) : edge{b - a, c - b, d - c, a - d} {
    for (int i = 0; i < 4; ++i) jacobian[i] = cross(edge[(i + 3) % 4], edge[i]);
  }
  /// Least of f(i, previous edge, next edge) over the corners.
  template <class F>
  DMOSCOPE_ANYWHERE R least(F f) const {
    R result = f(0, edge[3], edge[0]);
    for (int i = 1; i < 4; ++i) result = min(result, f(i, edge[i - 1], edge[i]));
    return result;
  }
};

/// Smallest signed corner Jacobian (twice the area of the corner's triangle). Inverted means <= 0.
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> smallest_jacobian(const Triangle<V>& t) {
  return t.twice_area;
}
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> smallest_jacobian(const Quadrilateral<V>& q) {
  return min(min(q.jacobian[0], q.jacobian[1]), min(q.jacobian[2], q.jacobian[3]));
}

/// Interior angle between the edges u and v that leave a corner, 0 to pi. `area2`: |u x v|, the same at all three corners.
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> angle(RealOf<V> area2, V u, V v) {
  return atan2(area2, dot(u, v));
}

/// The least of three such angles, from the largest of the three u . v: one angle to compute.
template <class R>
DMOSCOPE_ANYWHERE R least_angle(R area2, R dot0, R dot1, R dot2) {
  return atan2(area2, scalar::max3(dot0, dot1, dot2));
}

/// sign(A) sin^2 of the least angle, which the two longest edges enclose.
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> signed_square_of_sine(const Triangle<V>& t) {
  const auto aa = dot(t.ab, t.ab), bb = dot(t.bc, t.bc), cc = dot(t.ca, t.ca);
  return scalar::ratio(t.twice_area * abs(t.twice_area), scalar::max3(aa * bb, bb * cc, cc * aa));
}

template <class V>
DMOSCOPE_ANYWHERE RealOf<V> squared_length_sum(const Triangle<V>& t) {
  return dot(t.ab, t.ab) + dot(t.bc, t.bc) + dot(t.ca, t.ca);
}

/// The definition of a metric, a specialisation each, in a header of this folder that formulas.h includes. It has
/// - kInfo: name, range and description;
/// - kSeesInversion: is it positive exactly where every corner Jacobian is?
/// - where it is defined for them: triangle(), quadrilateral(), tetrahedron(), and corner<Ideal>(u, v, w, jacobian), whose least over the
///   corners is the value of all other volume elements. Every value is 1 for the ideal element, <= 0 for an inverted or degenerate one;
/// - where they pay: rank_triangle(), rank_quadrilateral(), rank_tetrahedron(), rank_corner() with kRankPhrase, rank_doubt() and
///   of_volume_rank() (see rank()); kInPlane, another metric that is the same in the plane, whose code stands in there.
template <Metric M>
struct Formula;

}  // namespace dmoscope::formulas
