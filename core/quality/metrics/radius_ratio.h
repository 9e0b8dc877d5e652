#pragma once

#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Triangle: sign(A) 2 r / R = sign(A) 16 A^2 / (l1 l2 l3 (l1 + l2 + l3)); tetrahedron: sign(V) 3 r / R.
template <>
struct Formula<Metric::RadiusRatio> {
  static constexpr MetricInfo kInfo{Metric::RadiusRatio,
                                    "radius-ratio",
                                    "Radius ratio",
                                    -1.0,
                                    1.0,
                                    0.3,
                                    "triangle: sign(A) 2 r / R;  tetrahedron: sign(V) 3 r / R",
                                    "Incircle against circumcircle, insphere against circumsphere."};
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    return scalar::ratio(R(4) * t.twice_area * abs(t.twice_area), a * b * c * (a + b + c));
  }

  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const V n = dot(t.ad, t.ad) * cross(t.ab, t.ac) + dot(t.ac, t.ac) * cross(t.ad, t.ab) + dot(t.ab, t.ab) * cross(t.ac, t.ad);
    return R(6) * scalar::ratio(t.six_volume, twice_surface(t)) * scalar::ratio(abs(t.six_volume), sqrt(dot(n, n)));
  }
};

}  // namespace dmoscope::formulas
