#pragma once
// From the corners of a mesh's element to what the formulas take. For the judges of this folder, not for the rest of the program.

#include <limits>
#include <span>

#include "core/base/anywhere.h"
#include "core/quality/formulas.h"
#include "core/quality/quality.h"

namespace dmoscope {

/// A vector of a curved surface: its cross product is taken against a given unit normal.
struct SurfaceVector {
  Vec3 v, normal;
  friend SurfaceVector operator-(SurfaceVector a, SurfaceVector b) { return {a.v - b.v, b.normal}; }
};
[[nodiscard]] inline double dot(SurfaceVector a, SurfaceVector b) { return dot(a.v, b.v); }
[[nodiscard]] inline double cross(SurfaceVector a, SurfaceVector b) { return dot(cross(a.v, b.v), b.normal); }

[[nodiscard]] inline Vec3 unit_normal(Vec3 a, Vec3 b, Vec3 fallback) {
  const Vec3 n = cross(a, b);
  const double l = length(n);
  return l > 0.0 ? (1.0 / l) * n : fallback;
}

/// The shape of a planar triangle or quadrilateral (by the number of its corners) from differences from its first corner, so that nothing
/// is lost far from the origin: visitor(Triangle) or visitor(Quadrilateral). at(vertex): its position.
template <class At, class Visitor>
DMOSCOPE_ANYWHERE auto visit_planar(const Plane& plane, std::span<const Index> corners, At at, Visitor visitor) {
  using V = Vec2<double>;
  const Vec3 origin = at(corners[0]);
  const V b = plane.project(at(corners[1]) - origin), c = plane.project(at(corners[2]) - origin);
  if (corners.size() == 3) return visitor(formulas::Triangle<V>({}, b, c));
  return visitor(formulas::Quadrilateral<V>({}, b, c, plane.project(at(corners[3]) - origin)));
}

/// The same of an element of a planar or curved mesh; fallback for other kinds.
template <class Result, class Visitor>
[[nodiscard]] Result visit_element(const QualityContext& context, PositionView positions, Index element, Result fallback, Visitor visitor) {
  const ElementKind kind = context.mesh.elements.kind(element);
  if (kind != ElementKind::Triangle && kind != ElementKind::Quadrilateral) return fallback;
  const auto corners = context.mesh.elements.corners(element);
  if (context.geometry.shape == Shape::Planar)
    return visit_planar(
        context.geometry.plane, corners, [&](Index vertex) { return positions[vertex]; }, visitor);
  const Vec3 origin = positions[corners[0]];
  const Vec3 b = positions[corners[1]] - origin, c = positions[corners[2]] - origin;
  const Vec3 d = kind == ElementKind::Quadrilateral ? positions[corners[3]] - origin : Vec3{};
  const Plane& plane = context.geometry.plane;
  using V = SurfaceVector;
  if (kind == ElementKind::Triangle) {
    const Vec3 n = unit_normal(b, c, plane.normal);  // a surface triangle has no sign
    return visitor(formulas::Triangle<V>({{}, n}, {b, n}, {c, n}));
  }
  const Vec3 n = context.geometry.mostly_flat ? plane.normal : unit_normal(c, d - b, plane.normal);
  return visitor(formulas::Quadrilateral<V>({{}, n}, {b, n}, {c, n}, {d, n}));
}

/// The metric of a triangle or quadrilateral of vectors V; NaN where it is not defined. Never -0, of which double and packs of it choose
/// otherwise between equals.
template <Metric M, class V>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::Triangle<V>& t) {
  return formulas::Formula<M>::triangle(t) + formulas::RealOf<V>(0.0);
}
template <Metric M, class V>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::Quadrilateral<V>& q) {
  if constexpr (formulas::kDefinedForQuadrilaterals<M, V>)
    return formulas::Formula<M>::quadrilateral(q) + formulas::RealOf<V>(0.0);
  else
    return formulas::RealOf<V>(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace dmoscope
