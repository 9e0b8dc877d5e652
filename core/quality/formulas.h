#pragma once
// All metrics, each defined once (core/quality/metrics), for any scalar; and how the rest of the program asks them.

#include <utility>

#include "core/quality/metric.h"
#include "core/quality/metrics/aspect_ratio.h"
#include "core/quality/metrics/condition.h"
#include "core/quality/metrics/max_angle.h"
#include "core/quality/metrics/mean_ratio.h"
#include "core/quality/metrics/mean_ratio_area.h"
#include "core/quality/metrics/min_angle.h"
#include "core/quality/metrics/radius_ratio.h"
#include "core/quality/metrics/rectangularity.h"
#include "core/quality/metrics/scaled_jacobian.h"

namespace dmoscope::formulas {

/// The metric itself.
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Triangle<V>& t) {
  return Formula<M>::triangle(t);
}
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Quadrilateral<V>& q) {
  return Formula<M>::quadrilateral(q);
}

/// The value that the fast search compares instead of the metric: one increasing function of it for all elements, 0 where it is 0, that
/// costs less, so that the same candidate wins. How exact it is: rank_doubt().
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

/// The metric while corner `moving` of an element moves. Simplices and quadrilaterals: the whole metric. Other volume elements:
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

template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Tetrahedron<V>& t) {
  return Formula<M>::tetrahedron(t);
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> metric(const CorneredSolid<V, Ideal, N, Corners>& s) {
  return s.least([](V u, V v, V w, RealOf<V> jacobian) { return Formula<M>::template corner<Ideal>(u, v, w, jacobian); });
}

/// metric() and metric_around() in one.
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE WholeAndAround<RealOf<V>> metric_whole_and_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  return s.least_whole_and_around(moving,
                                  [](V u, V v, V w, RealOf<V> jacobian) { return Formula<M>::template corner<Ideal>(u, v, w, jacobian); });
}
/// metric_whole_and_around() of shapes that are judged as a whole.
template <Metric M, class Shape>
DMOSCOPE_ANYWHERE auto metric_whole_and_around(const Shape& shape, Index /*moving*/) {
  const auto value = metric<M>(shape);
  return WholeAndAround<std::remove_cv_t<decltype(value)>>{value, value};
}

template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> rank(const Tetrahedron<V>& t) {
  if constexpr (requires { Formula<M>::rank_tetrahedron(t); })
    return Formula<M>::rank_tetrahedron(t);
  else
    return metric<M>(t);
}

template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> metric_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  return s.least_around(moving, [](V u, V v, V w, RealOf<V> jacobian) { return Formula<M>::template corner<Ideal>(u, v, w, jacobian); });
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> rank_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  if constexpr (requires { Formula<M>::template rank_corner<Ideal>(V{}, V{}, V{}, RealOf<V>(0)); })
    return s.least_around(moving,
                          [](V u, V v, V w, RealOf<V> jacobian) { return Formula<M>::template rank_corner<Ideal>(u, v, w, jacobian); });
  else
    return metric_around<M>(s, moving);
}

/// By how much another rank in double must differ from `rank` (from 1e-4 on) for it to be certain which element is better: a few roundings,
/// where the metric does not say otherwise.
template <Metric M>
[[gnu::always_inline]] DMOSCOPE_ANYWHERE double rank_doubt(double rank) {
  if constexpr (requires { Formula<M>::rank_doubt(rank); })
    return Formula<M>::rank_doubt(rank);
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
template <Metric M>
inline constexpr bool kDefinedForTetrahedra = requires(const Tetrahedron<Vec3Of<double>>& t) {
  Formula<M>::tetrahedron(t);
};
/// For hexahedra, wedges and pyramids?
template <Metric M>
inline constexpr bool kDefinedForCorners = requires(Vec3Of<double> v) {
  Formula<M>::template corner<CubeCorner>(v, v, v, 0.0);
};

/// The metrics that have code of their own for planar elements, for volume elements, for any.
struct OfPlanarElements {
  template <Metric M>
  static constexpr bool kHas = (kDefinedForTriangles<M, Vec2<double>> || kDefinedForQuadrilaterals<M, Vec2<double>>)&&!requires {
    Formula<M>::kInPlane;
  };
};
struct OfVolumeElements {
  template <Metric M>
  static constexpr bool kHas = kDefinedForTetrahedra<M> || kDefinedForCorners<M>;
};
struct OfAnyElements {
  template <Metric M>
  static constexpr bool kHas = true;
};

/// Calls f.template operator()<M>() with the run-time metric as a template argument, if it is one of Those; with MeanRatio for any other
/// that is built in.
template <class Those, std::size_t I = 0, class F>
DMOSCOPE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_one_of(Metric metric, F&& f) {
  if constexpr (I == kMetricCount) {
#if !defined(__CUDA_ARCH__)
    if (!is_built_in(metric)) refuse_defined_metric();
#endif
    return f.template operator()<Metric::MeanRatio>();
  } else {
    constexpr Metric kThis = static_cast<Metric>(I);
    if constexpr (Those::template kHas<kThis> && kThis != Metric::MeanRatio)
      if (metric == kThis) return f.template operator()<kThis>();
    return with_one_of<Those, I + 1>(metric, std::forward<F>(f));
  }
}
template <class F>
DMOSCOPE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_planar_metric(Metric metric, F&& f) {
  return with_one_of<OfPlanarElements>(metric, std::forward<F>(f));
}
template <class F>
DMOSCOPE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_volume_metric(Metric metric, F&& f) {
  return with_one_of<OfVolumeElements>(metric, std::forward<F>(f));
}
template <class F>
decltype(auto) with_metric(Metric metric, F&& f) {
  return with_one_of<OfAnyElements>(metric, std::forward<F>(f));
}

}  // namespace dmoscope::formulas
