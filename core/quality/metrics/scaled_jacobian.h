#pragma once

#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Triangle: (2 / sqrt 3) 2A / largest product of two edges; quadrilateral: least a_i / (l_i l_{i-1}). Verdict.
/// Tetrahedron: sqrt(2) 6V / largest product of three edges at a corner; else the least corner's determinant of unit edges. Verdict.
template <>
struct Formula<Metric::ScaledJacobian> {
  static constexpr MetricInfo kInfo{
      Metric::ScaledJacobian,
      "scaled-jacobian",
      "Scaled Jacobian",
      -1.0,
      1.0,
      0.5,
      "triangle: (2/√3) 2A / largest product of two edges;  quadrilateral: min aᵢ / (lᵢ lᵢ₋₁);  tetrahedron: √2 6V / largest product of "
      "three edges at a corner;  hexahedron: least corner determinant of unit edges (wedge: × 2/√3, pyramid's base: × √2)",
      "Sine of the worst corner, or its counterpart in a volume (Verdict)."};
  static constexpr bool kSeesInversion = true;
  static constexpr std::string_view kRankPhrase = "squared scaled Jacobian";
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

  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const auto l = [](V e) { return sqrt(dot(e, e)); };
    const R ab = l(t.ab), ac = l(t.ac), ad = l(t.ad), bc = l(t.bc), bd = l(t.bd), cd = l(t.cd);
    const R product = scalar::max3(ab * ac * ad, ab * bc * bd, max(ac * bc * cd, ad * bd * cd));
    return scalar::ratio(scalar::constant<R>(std::numbers::sqrt2) * t.six_volume, product);
  }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return scalar::ratio(scalar::constant<R>(Ideal::kSine) * jacobian, sqrt(dot(u, u)) * sqrt(dot(v, v)) * sqrt(dot(w, w)));
  }
};

}  // namespace dmoscope::formulas
