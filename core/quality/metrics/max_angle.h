#pragma once

#include "core/quality/metrics/planar_shapes.h"

namespace dmoscope::formulas {

/// sign(A) 3/2 (1 - theta_max / pi).
template <>
struct Formula<Metric::MaxAngle> {
  static constexpr MetricInfo kInfo{Metric::MaxAngle,
                                    "max-angle",
                                    "Maximum angle",
                                    -1.0,
                                    1.0,
                                    0.5,
                                    "sign(A) 1.5 (1 − θmax / π)",
                                    "Largest angle against 60°; 0 at 180°."};
  static constexpr bool kSeesInversion = true;
  static constexpr std::string_view kRankPhrase = "tangent of half the angle outside the largest angle";
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

}  // namespace dmoscope::formulas
