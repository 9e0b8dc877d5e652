#include "core/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/thread_pool.h"
#include "core/quality/formulas.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kGrain = 8192;

/// A vector of a curved surface: its cross product is taken against a given unit normal.
struct SurfaceVector {
  Vec3 v, normal;
  friend SurfaceVector operator-(SurfaceVector a, SurfaceVector b) { return {a.v - b.v, b.normal}; }
};
double dot(SurfaceVector a, SurfaceVector b) { return dot(a.v, b.v); }
double cross(SurfaceVector a, SurfaceVector b) { return dot(cross(a.v, b.v), b.normal); }

Vec3 unit_normal(Vec3 a, Vec3 b, Vec3 fallback) {
  const Vec3 n = cross(a, b);
  const double l = length(n);
  return l > 0.0 ? (1.0 / l) * n : fallback;
}

/// Calls visitor(Triangle) or visitor(Quadrilateral) with the element's corners as differences from its first one, so that nothing
/// is lost far from the origin; fallback for other kinds.
template <class Visitor>
double visit_element(const QualityContext& context, std::span<const Vec3> positions, Index element, double fallback, Visitor visitor) {
  const ElementKind kind = context.mesh.elements.kind(element);
  if (kind != ElementKind::Triangle && kind != ElementKind::Quadrilateral) return fallback;
  const auto corners = context.mesh.elements.corners(element);
  const Vec3 origin = positions[corners[0]];
  const Vec3 b = positions[corners[1]] - origin, c = positions[corners[2]] - origin;
  const Vec3 d = kind == ElementKind::Quadrilateral ? positions[corners[3]] - origin : Vec3{};
  const Plane& plane = context.geometry.plane;
  if (context.geometry.shape == Shape::Planar) {
    using V = Vec2<double>;
    if (kind == ElementKind::Triangle) return visitor(formulas::Triangle<V>({}, plane.project(b), plane.project(c)));
    return visitor(formulas::Quadrilateral<V>({}, plane.project(b), plane.project(c), plane.project(d)));
  }
  using V = SurfaceVector;
  if (kind == ElementKind::Triangle) {
    const Vec3 n = unit_normal(b, c, plane.normal);  // a surface triangle has no sign
    return visitor(formulas::Triangle<V>({{}, n}, {b, n}, {c, n}));
  }
  const Vec3 n = context.geometry.mostly_flat ? plane.normal : unit_normal(c, d - b, plane.normal);
  return visitor(formulas::Quadrilateral<V>({{}, n}, {b, n}, {c, n}, {d, n}));
}

template <Metric M>
struct Evaluate {
  template <class V>
  double operator()(const formulas::Triangle<V>& t) const {
    return formulas::Formula<M>::triangle(t);
  }
  template <class V>
  double operator()(const formulas::Quadrilateral<V>& q) const {
    if constexpr (formulas::kDefinedForQuadrilaterals<M, V>)
      return formulas::Formula<M>::quadrilateral(q);
    else
      return kUndefined;
  }
};

struct EvaluateJacobian {
  template <class E>
  double operator()(const E& element) const {
    return formulas::smallest_jacobian(element);
  }
};

template <Metric M>
double quality_of(const QualityContext& context, std::span<const Vec3> positions, Index element) {
  return visit_element(context, positions, element, kUndefined, Evaluate<M>{});
}

/// What one chunk of elements adds to the statistics.
struct Partial {
  double minimum = kInfinity, movable = kInfinity, ceiling = kInfinity, sum = 0.0;
  Index worst = kNoIndex, inverted = 0;
  std::size_t defined = 0;
};

void add_element(Partial& partial, const QualityContext& context, std::span<const std::uint8_t> fixed, Index e, double q, double jacobian) {
  partial.inverted += jacobian <= 0.0 ? 1U : 0U;
  if (std::isnan(q)) return;
  partial.sum += q;
  ++partial.defined;
  if (q < partial.minimum) {
    partial.minimum = q;
    partial.worst = e;
  }
  const auto corners = context.mesh.elements.corners(e);
  double& bound = std::ranges::all_of(corners, [&](Index v) { return fixed[v] != 0; }) ? partial.ceiling : partial.movable;
  bound = std::min(bound, q);
}

}  // namespace

double element_quality(const QualityContext& context, std::span<const Vec3> positions, Metric metric, Index element) {
  return formulas::with_metric(metric, [&]<Metric M>() { return quality_of<M>(context, positions, element); });
}

double smallest_jacobian(const QualityContext& context, std::span<const Vec3> positions, Index element) {
  return visit_element(context, positions, element, kInfinity, EvaluateJacobian{});
}

void element_qualities(const QualityContext& context, std::span<const Vec3> positions, Metric metric, ThreadPool* pool,
                       std::span<double> out) {
  formulas::with_metric(metric, [&]<Metric M>() {
    for_chunks(pool, out.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) out[e] = quality_of<M>(context, positions, static_cast<Index>(e));
    });
  });
}

double vertex_quality(const QualityContext& context, const Topology& topology, std::span<const Vec3> positions, Metric metric,
                      Index vertex) {
  return formulas::with_metric(metric, [&]<Metric M>() {
    double least = kInfinity;
    for (const Incidence& incidence : topology.star(vertex)) least = std::min(least, quality_of<M>(context, positions, incidence.element));
    return least;
  });
}

Statistics compute_statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                              std::span<const std::uint8_t> fixed, ThreadPool* pool) {
  const std::size_t count = context.mesh.elements.size();
  std::vector<Partial> partials((count + kGrain - 1) / kGrain);
  formulas::with_metric(metric, [&]<Metric M>() {
    for_chunks(pool, count, kGrain, [&](std::size_t first, std::size_t last) {
      Partial& partial = partials[first / kGrain];
      for (std::size_t i = first; i < last; ++i) {
        const Index e = static_cast<Index>(i);
        add_element(partial, context, fixed, e, quality_of<M>(context, positions, e), smallest_jacobian(context, positions, e));
      }
    });
  });
  Partial total;
  for (const Partial& partial : partials) {  // in the order of the elements: the same sum for any number of threads
    if (partial.minimum < total.minimum) {
      total.minimum = partial.minimum;
      total.worst = partial.worst;
    }
    total.movable = std::min(total.movable, partial.movable);
    total.ceiling = std::min(total.ceiling, partial.ceiling);
    total.sum += partial.sum;
    total.inverted += partial.inverted;
    total.defined += partial.defined;
  }
  return {total.minimum, total.defined > 0 ? total.sum / static_cast<double>(total.defined) : kUndefined,
          total.movable, total.ceiling,
          total.worst,   total.inverted};
}

}  // namespace dmoscope
