#pragma once

#include "core/quality/metrics/mean_ratio.h"
#include "core/quality/metrics/planar_shapes.h"

namespace dmoscope::formulas {

/// Paper eq. (11), scaled to 1 for the square: 4 A / sum l^2. Cannot see a concave corner. On triangles it is the mean ratio.
template <>
struct Formula<Metric::MeanRatioArea> {
  static constexpr MetricInfo kInfo{Metric::MeanRatioArea,
                                    "mean-ratio-area",
                                    "Mean ratio by area",
                                    -1.0,
                                    1.0,
                                    0.3,
                                    "quadrilateral: 4 A / Σ l²;  triangle: the mean ratio",
                                    "The paper's quadrilateral metric (eq. 11) scaled to 1 for a square. It cannot see a concave corner."};
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

}  // namespace dmoscope::formulas
