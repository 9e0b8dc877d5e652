#pragma once

#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Triangle: 4 sqrt(3) A / (l_max (l1 + l2 + l3)); tetrahedron: sign(V) 2 sqrt(6) r / l_max. Verdict, inverted.
template <>
struct Formula<Metric::AspectRatio> {
  static constexpr MetricInfo kInfo{Metric::AspectRatio,
                                    "aspect-ratio",
                                    "Aspect ratio",
                                    -1.0,
                                    1.0,
                                    0.3,
                                    "triangle: 4√3 A / (lmax Σ l);  tetrahedron: sign(V) 2√6 r / lmax",
                                    "Longest edge against the inradius (Verdict's value inverted)."};
  static constexpr bool kSeesInversion = true;
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> triangle(const Triangle<V>& t) {
    using R = RealOf<V>;
    const R a = sqrt(dot(t.ab, t.ab)), b = sqrt(dot(t.bc, t.bc)), c = sqrt(dot(t.ca, t.ca));
    return scalar::ratio(scalar::constant<R>(2.0 * sqrt3) * t.twice_area, scalar::max3(a, b, c) * (a + b + c));
  }

  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    return scalar::ratio(scalar::constant<R>(2.0 * std::numbers::sqrt2 * sqrt3) * t.six_volume, twice_surface(t) * longest_edge(t));
  }
};

}  // namespace dmoscope::formulas
