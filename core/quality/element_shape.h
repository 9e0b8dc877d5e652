#pragma once
// From the corners of a mesh's element to what the formulas take. For the judges of this folder, not for the rest of the program.

#include <limits>
#include <span>
#include <type_traits>

#include "core/base/host_device.h"
#include "core/mesh/element_frame.h"
#include "core/quality/formulas.h"
#include "core/quality/quality.h"

namespace dmoscope {

/// The shape of a planar triangle or quadrilateral (by the number of its corners) from differences from its first corner, so that nothing
/// is lost far from the origin: visitor(Triangle) or visitor(Quadrilateral). at(vertex): its position.
template <class At, class Visitor>
DMOSCOPE_ANYWHERE auto visit_planar(const Plane& plane, std::span<const Index> corners, At at, Visitor visitor) {
  using V = Vec2<double>;
  const Vec3 origin = at(corners[0]);
  const V b = plane.offset(at(corners[1]), origin), c = plane.offset(at(corners[2]), origin);
  if (corners.size() == 3) return visitor(formulas::Triangle<V>({}, b, c));
  return visitor(formulas::Quadrilateral<V>({}, b, c, plane.offset(at(corners[3]), origin)));
}

/// The shape of a volume element; its kind follows from the number of its corners. Edges are differences of positions: nothing is lost far
/// from the origin, and what does not depend on a corner keeps its bits when that corner moves. at(vertex): its position, or a pack of
/// them.
template <class At, class Visitor>
DMOSCOPE_ANYWHERE auto visit_volume(std::span<const Index> corners, At at, Visitor visitor) {
  using V = std::remove_cvref_t<decltype(at(corners[0]))>;
  const auto corner = [&](std::size_t i) { return at(corners[i]); };
  switch (corners.size()) {
    case 4:
      return visitor(formulas::Tetrahedron<V>(corner(0), corner(1), corner(2), corner(3)));
    case 5:
      return visitor(formulas::Pyramid<V>{{corner(0), corner(1), corner(2), corner(3), corner(4)}});
    case 6:
      return visitor(formulas::Wedge<V>{{corner(0), corner(1), corner(2), corner(3), corner(4), corner(5)}});
    default:
      return visitor(formulas::Hexahedron<V>{{corner(0), corner(1), corner(2), corner(3), corner(4), corner(5), corner(6), corner(7)}});
  }
}

/// The shape of an element of a mesh whose elements' dimension is that of its frame.
template <class At, class Visitor>
DMOSCOPE_ANYWHERE auto visit_shape(const Plane& plane, std::span<const Index> corners, At at, Visitor visitor) {
  return visit_planar(plane, corners, at, visitor);
}
template <class At, class Visitor>
DMOSCOPE_ANYWHERE auto visit_shape(const Space& /*space*/, std::span<const Index> corners, At at, Visitor visitor) {
  return visit_volume(corners, at, visitor);
}

/// The shape of a triangle or quadrilateral of a curved mesh.
template <class At, class Visitor>
[[nodiscard]] auto visit_shape(const Curved& frame, std::span<const Index> corners, At at, Visitor visitor) {
  const Vec3 origin = at(corners[0]);
  const Vec3 b = at(corners[1]) - origin, c = at(corners[2]) - origin;
  using V = SurfaceVector;
  if (corners.size() == 3) {
    const Vec3 n = curved_normal(b, c, frame.normal, frame.against);  // else a surface triangle has no sign
    return visitor(formulas::Triangle<V>({{}, n}, {b, n}, {c, n}));
  }
  const Vec3 d = at(corners[3]) - origin;
  const Vec3 n = frame.mostly_flat ? frame.normal : curved_normal(c, d - b, frame.normal, frame.against);
  return visitor(formulas::Quadrilateral<V>({{}, n}, {b, n}, {c, n}, {d, n}));
}

/// The shape of any element of a mesh.
template <class Visitor>
[[nodiscard]] auto visit_element(const QualityContext& context, PositionView positions, Index element, Visitor visitor) {
  const auto corners = context.mesh.elements.corners(element);
  const auto at = [&](Index vertex) { return positions[vertex]; };
  if (info(context.mesh.elements.kind(element)).dimension == 3) return visit_volume(corners, at, visitor);
  if (context.geometry.shape == Shape::Planar) return visit_planar(context.geometry.plane, corners, at, visitor);
  const Curved frame{context.geometry.plane.normal, context.geometry.mostly_flat,
                     context.normals.empty() ? nullptr : context.normals.data()};
  return visit_shape(frame.of(element), corners, at, visitor);
}

/// The metric of a triangle or quadrilateral of vectors V; NaN where it is not defined. Never -0: double and packs of it would choose
/// differently between -0 and 0.
template <Metric M, class V>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::Triangle<V>& t) {
  if constexpr (formulas::kDefinedForTriangles<M, V>)
    return formulas::Formula<M>::triangle(t) + formulas::RealOf<V>(0.0);
  else
    return formulas::RealOf<V>(std::numeric_limits<double>::quiet_NaN());
}
template <Metric M, class V>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::Quadrilateral<V>& q) {
  if constexpr (formulas::kDefinedForQuadrilaterals<M, V>)
    return formulas::Formula<M>::quadrilateral(q) + formulas::RealOf<V>(0.0);
  else
    return formulas::RealOf<V>(std::numeric_limits<double>::quiet_NaN());
}

/// The metric of a volume element; NaN where it is not defined.
template <Metric M, class V>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::Tetrahedron<V>& t) {
  if constexpr (formulas::kDefinedForTetrahedra<M>)
    return formulas::metric<M>(t) + formulas::RealOf<V>(0.0);
  else
    return formulas::RealOf<V>(std::numeric_limits<double>::quiet_NaN());
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate(const formulas::CorneredSolid<V, Ideal, N, Corners>& s) {
  if constexpr (formulas::kDefinedForCorners<M>)
    return formulas::metric<M>(s) + formulas::RealOf<V>(0.0);
  else
    return formulas::RealOf<V>(std::numeric_limits<double>::quiet_NaN());
}

/// The quality that matters while corner `moving` moves: see formulas::metric_around.
template <Metric M, class Shape>
[[nodiscard]] DMOSCOPE_ANYWHERE auto evaluate_around(const Shape& shape, Index /*moving*/) {
  return evaluate<M>(shape);
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<V> evaluate_around(const formulas::CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  if constexpr (formulas::kDefinedForCorners<M>)
    return formulas::metric_around<M>(s, moving) + formulas::RealOf<V>(0.0);
  else
    return evaluate<M>(s);
}

}  // namespace dmoscope
