#pragma once
// The definition of every metric, once, for any scalar and any vector type V that offers operator-, dot(V, V) and a signed
// cross(V, V): points of the plane in double (statistics), in float or packs of float (search), vectors of a curved surface.
//
// Corners run counter-clockwise. Every value is 1 for the ideal element, <= 0 for an inverted or degenerate one
// (mean-ratio-area cannot see a concave corner).

#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/numeric/scalar.h"
#include "core/quality/metric.h"

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

/// atan2(y, x) in right angles, 0 to 2, for y >= 0. Minimax polynomial, absolute error below 3e-8.
template <class R>
DMOSCOPE_ANYWHERE R right_angles(R y, R x) {
  constexpr double kCoefficients[] = {-0.002581223011, 0.01391841026, -0.03559491945, 0.0613841536,
                                      -0.08854509287,  0.1269837822,  -0.212184484,   0.6366193494};
  const R width = abs(x);
  const R r = min(width, y) / max(max(width, y), scalar::constant<R>(1e-37)), square = r * r;
  // Pairs first (Estrin): a shorter chain than one coefficient after the other.
  const auto pair = [&](int i) { return scalar::constant<R>(kCoefficients[i]) * square + scalar::constant<R>(kCoefficients[i + 1]); };
  const R fourth = square * square;
  R value = (pair(0) * fourth + pair(2)) * (fourth * fourth) + (pair(4) * fourth + pair(6));
  value = value * r;
  value = select(y > width, R(1) - value, value);
  return select(x < R(0), R(2) - value, value);
}

template <class V>
DMOSCOPE_ANYWHERE RealOf<V> squared_length_sum(const Triangle<V>& t) {
  return dot(t.ab, t.ab) + dot(t.bc, t.bc) + dot(t.ca, t.ca);
}

/// One specialisation a metric: triangle(...) and, where defined, quadrilateral(...).
/// kSeesInversion: positive exactly where every corner Jacobian is positive.
/// rank_triangle(...), rank_quadrilateral(...), where there are: see rank().
template <Metric M>
struct Formula;

/// The metric itself.
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Triangle<V>& t) {
  return Formula<M>::triangle(t);
}
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Quadrilateral<V>& q) {
  return Formula<M>::quadrilateral(q);
}

/// What the fast search compares instead of the metric: one increasing function of it for all elements, 0 where it is 0, that costs
/// less, so that the same candidate wins. How exact it is: rank_doubt().
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> rank(const Triangle<V>& t) {
  if constexpr (requires { Formula<M>::rank_triangle(t); })
    return Formula<M>::rank_triangle(t);
  else
    return metric<M>(t);
}
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> rank(const Quadrilateral<V>& q) {
  if constexpr (requires { Formula<M>::rank_quadrilateral(q); })
    return Formula<M>::rank_quadrilateral(q);
  else
    return metric<M>(q);
}

/// The metric while corner `moving` of an element moves. Simplices and quadrilaterals: the whole metric. Other volume elements (volumes.h):
/// only the corners that change; the others say nothing about where the vertex should be, and the worst of them would hold it in place.
/// A shape may know its quality itself: that of a metric that is defined while the program runs.
template <Metric M, class Shape>
DMOSCOPE_ANYWHERE auto metric_around(const Shape& shape, Index /*moving*/) {
  if constexpr (requires { shape.own_quality(); })
    return shape.own_quality();
  else
    return metric<M>(shape);
}
template <Metric M, class Shape>
DMOSCOPE_ANYWHERE auto rank_around(const Shape& shape, Index /*moving*/) {
  return rank<M>(shape);
}
template <class Shape>
DMOSCOPE_ANYWHERE auto smallest_jacobian_around(const Shape& shape, Index moving) {
  if constexpr (requires { shape.own_quality(); })
    return smallest_jacobian_around(shape.shape(), moving);
  else
    return smallest_jacobian(shape);
}

/// Paper eq. (4); quadrilateral: Knupp's shape, least corner.
template <>
struct Formula<Metric::MeanRatio> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    return scalar::ratio(scalar::constant<R>(2.0 * sqrt3) * t.twice_area, squared_length_sum(t));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> quadrilateral(const Quadrilateral<V>& q) {
    using R = RealOf<V>;
    return q.least([&](int i, V u, V v) { return scalar::ratio(R(2) * q.jacobian[i], dot(u, u) + dot(v, v)); });
  }
};

/// Paper eq. (11), scaled to 1 for the square: 4 A / sum l^2. Cannot see a concave corner. On triangles it is the mean ratio.
template <>
struct Formula<Metric::MeanRatioArea> {
  static constexpr bool kSeesInversion = false;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    return Formula<Metric::MeanRatio>::triangle(t);
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> quadrilateral(const Quadrilateral<V>& q) {
    using R = RealOf<V>;
    const R sum = dot(q.edge[0], q.edge[0]) + dot(q.edge[1], q.edge[1]) + dot(q.edge[2], q.edge[2]) + dot(q.edge[3], q.edge[3]);
    return scalar::ratio(R(2) * (q.jacobian[1] + q.jacobian[3]), sum);  // 2 A = the two triangles at opposite corners
  }
};

/// sign(A) 2 r / R = sign(A) 16 A^2 / (l1 l2 l3 (l1 + l2 + l3)).
template <>
struct Formula<Metric::RadiusRatio> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    return scalar::ratio(R(4) * t.twice_area * abs(t.twice_area), a * b * c * (a + b + c));
  }
};

/// sign(A) 3 theta_min / pi.
template <>
struct Formula<Metric::MinAngle> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R area2 = abs(t.twice_area);
    const R least = least_angle(area2, dot(t.ab, V{} - t.ca), dot(t.bc, V{} - t.ab), dot(t.ca, V{} - t.bc));
    return scalar::sign(t.twice_area) * scalar::constant<R>(3.0 / pi) * least;
  }
  /// The least angle is at most 60 degrees, where its sine still rises.
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_triangle(const Triangle<V>& t) {
    return signed_square_of_sine(t);
  }
};

/// sign(A) 3/2 (1 - theta_max / pi).
template <>
struct Formula<Metric::MaxAngle> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R area2 = abs(t.twice_area);
    // pi - theta is the angle to the edge that arrives at the corner: nothing cancels near theta = pi.
    const R least = least_angle(area2, dot(t.ab, t.ca), dot(t.bc, t.ab), dot(t.ca, t.bc));
    return scalar::sign(t.twice_area) * scalar::constant<R>(1.5 / pi) * least;
  }
  /// The tangent of half the outer angle: |u x v| / (|u| |v| - u . v).
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_triangle(const Triangle<V>& t) {
    const auto a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    return scalar::ratio(t.twice_area, scalar::max3(a * c + dot(t.ab, t.ca), b * a + dot(t.bc, t.ab), c * b + dot(t.ca, t.bc)));
  }
};

/// Paper eq. (9), (10): the best corner's closeness to a right angle with equal legs. One right angle is wanted, hence max.
template <>
struct Formula<Metric::Rectangularity> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R area2 = abs(t.twice_area);
    const R a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    const R right_angle = scalar::constant<R>(0.5 * pi);
    const auto corner = [&](V u, V v, R length_u, R length_v) {
      const R closeness = R(1) - abs(right_angle - angle(area2, u, v)) / right_angle;
      return closeness * scalar::ratio(min(length_u, length_v), max(length_u, length_v));
    };
    const R best = scalar::max3(corner(t.ab, V{} - t.ca, a, c), corner(t.bc, V{} - t.ab, b, a), corner(t.ca, V{} - t.bc, c, b));
    return scalar::sign(t.twice_area) * best;
  }
  /// The metric times its absolute value, with two angles by a polynomial and the third by their sum.
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R area2 = abs(t.twice_area);
    const R aa = dot(t.ab, t.ab), bb = dot(t.bc, t.bc), cc = dot(t.ca, t.ca);
    const R at_a = right_angles(area2, R(0) - dot(t.ab, t.ca)), at_b = right_angles(area2, R(0) - dot(t.bc, t.ab));
    const auto corner = [](R right_angles, R u, R v) {
      const R closeness = R(1) - abs(R(1) - right_angles);
      return closeness * closeness * (min(u, v) / max(max(u, v), scalar::constant<R>(1e-37)));
    };
    const R best = scalar::max3(corner(at_a, aa, cc), corner(at_b, aa, bb), corner(R(2) - (at_a + at_b), bb, cc));
    return scalar::sign(t.twice_area) * best;
  }
};

/// Triangle: (2 / sqrt 3) 2A / largest product of two edges; quadrilateral: least a_i / (l_i l_{i-1}). Verdict.
template <>
struct Formula<Metric::ScaledJacobian> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R aa = dot(t.ab, t.ab), bb = dot(t.bc, t.bc), cc = dot(t.ca, t.ca);
    const R product = sqrt(scalar::max3(aa * bb, bb * cc, cc * aa));
    return scalar::ratio(scalar::constant<R>(2.0 / sqrt3) * t.twice_area, product);
  }
  /// The metric times its absolute value.
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_triangle(const Triangle<V>& t) {
    return scalar::constant<RealOf<V>>(4.0 / 3.0) * signed_square_of_sine(t);
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> quadrilateral(const Quadrilateral<V>& q) {
    return q.least([&](int i, V u, V v) { return scalar::ratio(q.jacobian[i], sqrt(dot(u, u) * dot(v, v))); });
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_quadrilateral(const Quadrilateral<V>& q) {
    return q.least([&](int i, V u, V v) { return scalar::ratio(q.jacobian[i] * abs(q.jacobian[i]), dot(u, u) * dot(v, v)); });
  }
};

/// 4 sqrt(3) A / (l_max (l1 + l2 + l3)). Verdict, inverted.
template <>
struct Formula<Metric::AspectRatio> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    return scalar::ratio(scalar::constant<R>(2.0 * sqrt3) * t.twice_area, scalar::max3(a, b, c) * (a + b + c));
  }
};

/// Quadrilateral: 1 / the worst corner's condition number |J| |J^-1| / 2 = |J|^2 / (2 det J).
template <>
struct Formula<Metric::Condition> {
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> quadrilateral(const Quadrilateral<V>& q) {
    return Formula<Metric::MeanRatio>::quadrilateral(q);
  }
};

/// By how much another rank in double must differ from `rank` (from 1e-4 on) for it to be certain which element is better. Rectangularity's
/// polynomial errs by less than 5e-8 per angle, which changes its square by less than 1e-7 of the root; the others err by a few roundings.
template <Metric M>
[[gnu::always_inline]] DMOSCOPE_ANYWHERE double rank_doubt(double rank) {
  if constexpr (M == Metric::Rectangularity)
    return 3e-7 * std::sqrt(rank);
  else
    return 1e-10 * rank;
}

template <Metric M, class V>
inline constexpr bool kDefinedForTriangles = requires(const Triangle<V>& t) {
  Formula<M>::triangle(t);
};
template <Metric M, class V>
inline constexpr bool kDefinedForQuadrilaterals = requires(const Quadrilateral<V>& q) {
  Formula<M>::quadrilateral(q);
};

/// Calls f.template operator()<M>() with the run-time metric as a template argument. Of those that are defined in the plane: Condition is
/// the mean ratio there, and MeanRatio is called for it.
template <class F>
DMOSCOPE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_planar_metric(Metric metric, F&& f) {
  switch (metric) {
    case Metric::MeanRatioArea:
      return f.template operator()<Metric::MeanRatioArea>();
    case Metric::RadiusRatio:
      return f.template operator()<Metric::RadiusRatio>();
    case Metric::MinAngle:
      return f.template operator()<Metric::MinAngle>();
    case Metric::MaxAngle:
      return f.template operator()<Metric::MaxAngle>();
    case Metric::Rectangularity:
      return f.template operator()<Metric::Rectangularity>();
    case Metric::ScaledJacobian:
      return f.template operator()<Metric::ScaledJacobian>();
    case Metric::AspectRatio:
      return f.template operator()<Metric::AspectRatio>();
    case Metric::MeanRatio:
    case Metric::Condition:
      break;
    default:
#if !defined(__CUDA_ARCH__)
      refuse_defined_metric();
#else
      break;
#endif
  }
  return f.template operator()<Metric::MeanRatio>();
}
/// Calls f with any built-in metric.
template <class F>
decltype(auto) with_metric(Metric metric, F&& f) {
  if (metric == Metric::Condition) return f.template operator()<Metric::Condition>();
  return with_planar_metric(metric, std::forward<F>(f));
}

}  // namespace dmoscope::formulas
