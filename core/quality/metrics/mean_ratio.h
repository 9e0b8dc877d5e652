#pragma once

#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Triangle: paper eq. (4); quadrilateral: Knupp's shape, least corner; tetrahedron: 12 (3V)^(2/3) / sum l^2; corner of another volume
/// element: 3 det(A)^(2/3) / |A|^2 (Knupp). The rank in volumes is the metric's cube.
template <>
struct Formula<Metric::MeanRatio> {
  static constexpr MetricInfo kInfo{
      Metric::MeanRatio,
      "mean-ratio",
      "Mean ratio",
      -1.0,
      1.0,
      0.3,
      "triangle: 4√3 A / Σ l²;  quadrilateral: 2 min aᵢ / (lᵢ² + lᵢ₋₁²);  tetrahedron: 12 (3V)^⅔ / Σ l²;  hexahedron, wedge, pyramid: "
      "3 min det(Aᵢ)^⅔ / |Aᵢ|², Aᵢ a corner's Jacobian against the ideal one",
      "Shape; the paper's metric (eq. 4). Elements with other than simplex corners by their least corner (Knupp)."};
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

  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    return scalar::ratio(R(12) * signed_two_thirds(scalar::constant<R>(0.5) * t.six_volume), squared_length_sum(t));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_tetrahedron(const Tetrahedron<V>& t) {
    return RealOf<V>(432) * square_over_cube(t.six_volume, squared_length_sum(t));
  }
  static double of_volume_rank(double rank) { return std::cbrt(rank); }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return scalar::ratio(R(3) * signed_two_thirds(scalar::constant<R>(Ideal::kDeterminant) * jacobian),
                         squared_norm(Ideal::against_ideal(u, v, w)));
  }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return R(27) * square_over_cube(scalar::constant<R>(Ideal::kDeterminant) * jacobian, squared_norm(Ideal::against_ideal(u, v, w)));
  }
};

}  // namespace dmoscope::formulas
