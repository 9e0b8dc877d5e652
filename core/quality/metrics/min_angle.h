#pragma once

#include "core/quality/metrics/planar_shapes.h"
#include "core/quality/metrics/volume_shapes.h"

namespace dmoscope::formulas {

/// Triangle: sign(A) 3 theta_min / pi; tetrahedron: sign(V) times the least dihedral angle over that of the regular tetrahedron.
template <>
struct Formula<Metric::MinAngle> {
  static constexpr MetricInfo kInfo{Metric::MinAngle,
                                    "min-angle",
                                    "Minimum angle",
                                    -1.0,
                                    1.0,
                                    0.5,
                                    "triangle: sign(A) 3 θmin / π;  tetrahedron: sign(V) least dihedral angle / arccos ⅓",
                                    "Smallest angle against 60°; of tetrahedra the smallest dihedral angle against 70.53°."};
  static constexpr bool kSeesInversion = true;
  static constexpr std::string_view kRankPhrase = "squared sine of the smallest angle";
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

  static constexpr double kRegular = 1.2309594173407747;  // arccos(1/3)
  /// Calls f(|e| |six V|, n1 . n2, n1, n2) for every edge e, n1 and n2 the normals of its faces, |n1| |n2| sin = the first; the least.
  template <class V, class F>
  static DMOSCOPE_ANYWHERE RealOf<V> least(const Tetrahedron<V>& t, F f) {
    const RealOf<V> volume = abs(t.six_volume);
    const auto edge = [&](V e, V g, V h) { return f(sqrt(dot(e, e)) * volume, cross(e, g), cross(e, h)); };
    return min(min(min(edge(t.ab, t.ac, t.ad), edge(t.ac, t.ad, t.ab)), min(edge(t.ad, t.ab, t.ac), edge(t.bc, V{} - t.ab, t.bd))),
               min(edge(t.bd, V{} - t.ab, t.bc), edge(t.cd, t.ac, t.bc)));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const R angle = least(t, [](R sine, V n1, V n2) { return atan2(sine, dot(n1, n2)); });
    return scalar::sign(t.six_volume) * scalar::constant<R>(1.0 / kRegular) * angle;
  }
  /// The tangent of half the angle.
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const R tangent = least(t, [](R sine, V n1, V n2) {
      const R lengths = sqrt(dot(n1, n1)) * sqrt(dot(n2, n2)), cosine = dot(n1, n2);
      return scalar::ratio(sine, lengths + cosine);
    });
    return scalar::sign(t.six_volume) * tangent;
  }
  static double of_volume_rank(double rank) { return 2.0 * std::atan(rank) / kRegular; }
};

}  // namespace dmoscope::formulas
