#pragma once

#include "core/quality/metrics/planar_shapes.h"

namespace dmoscope::formulas {

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

/// Paper eq. (9), (10): the best corner's closeness to a right angle with equal legs. One right angle is wanted, hence max.
template <>
struct Formula<Metric::Rectangularity> {
  static constexpr MetricInfo kInfo{Metric::Rectangularity,
                                    "rectangularity",
                                    "Rectangularity",
                                    -1.0,
                                    1.0,
                                    0.5,
                                    "sign(A) maxᵢ (1 − |π/2 − θᵢ| / (π/2)) (1 − |eᵢⱼ − eᵢₖ| / max(eᵢⱼ, eᵢₖ))",
                                    "One right angle with equal legs (paper eq. 9, 10). Not quasiconcave."};
  static constexpr bool kSeesInversion = true;
  static constexpr std::string_view kRankPhrase = "squared rectangularity";
  /// The polynomial errs by less than 5e-8 per angle, which changes its square by less than 1e-7 of the root.
  static DMOSCOPE_ANYWHERE double rank_doubt(double rank) { return 3e-7 * std::sqrt(rank); }
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

}  // namespace dmoscope::formulas
