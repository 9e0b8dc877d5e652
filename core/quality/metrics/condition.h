#pragma once

#include "core/quality/metrics/mean_ratio.h"
#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Quadrilateral: 1 / the worst corner's condition number |J| |J^-1| / 2 = |J|^2 / (2 det J).
/// Volumes: 3 det(A) / (|A| |adj A|), A the corner's Jacobian against the ideal one, of a tetrahedron the same at every corner. Knupp.
template <>
struct Formula<Metric::Condition> {
  static constexpr MetricInfo kInfo{
      Metric::Condition,
      "condition",
      "Condition",
      -1.0,
      1.0,
      0.3,
      "quadrilateral: the mean ratio;  volumes: least 3 det(Aᵢ) / (|Aᵢ| |adj Aᵢ|), Aᵢ a corner's Jacobian against the ideal one",
      "Inverse of the worst corner's condition number (Knupp; Verdict's value inverted), signed."};
  static constexpr bool kSeesInversion = true;
  static constexpr Metric kInPlane = Metric::MeanRatio;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> quadrilateral(const Quadrilateral<V>& q) {
    return Formula<Metric::MeanRatio>::quadrilateral(q);
  }

  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    const std::array<V, 3> a = Ideal::against_ideal(u, v, w);
    const R adjoint = squared_norm(std::array<V, 3>{cross(a[0], a[1]), cross(a[1], a[2]), cross(a[2], a[0])});
    return scalar::ratio(scalar::constant<R>(3.0 * Ideal::kDeterminant) * jacobian, sqrt(squared_norm(a)) * sqrt(adjoint));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    return corner<TetrahedronCorner>(t.ab, t.ac, t.ad, t.six_volume);
  }
};

}  // namespace dmoscope::formulas
