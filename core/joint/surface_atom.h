#pragma once
// Atoms of a curved surface: triangles, and corners of quadrilaterals, in the planes of their elements, which turn with them.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/joint/atom_pieces.h"
#include "core/joint/dual_atom.h"
#include "core/mesh/element_frame.h"

namespace dmoscope {

/// Last vertex of an atom of a curved surface, by the number of corners of its element and the corner of the atom: see Atom.
[[nodiscard]] constexpr std::size_t opposite_corner(std::size_t corners, std::size_t corner) {
  return corners == 4 ? (corner + 2) % 4 : corner;
}

/// Quality of a triangle, or of a quadrilateral's corner, between the edges u and v.
template <Metric M, class V>
[[nodiscard]] formulas::RealOf<V> planar_quality(bool is_triangle, V u, V v) {
  return is_triangle ? pieces::Piece<M>::triangle(u, v) : pieces::square_corner<M>(u, v);
}

/// Normal of an atom's element, by the rule of curved_normal(), in any scalar. `frame`: the element's.
template <class R>
[[nodiscard]] Vec3Of<R> surface_normal(AtomShape shape, const std::array<Vec3Of<R>, 3>& e, const Curved& frame) {
  const bool is_triangle = shape == AtomShape::SurfaceTriangle;
  if (!is_triangle && frame.mostly_flat) return {R(frame.normal.x), R(frame.normal.y), R(frame.normal.z)};
  const Vec3Of<R> a = is_triangle ? e[0] : e[2], b = is_triangle ? e[1] : e[1] - e[0];
  if constexpr (std::is_same_v<R, double>) {
    return curved_normal(a, b, frame.normal, frame.against);
  } else {  // only for atoms that are not inverted
    using scalar::sqrt;
    const Vec3Of<R> n = cross(a, b);
    return (R(1.0) / sqrt(dot(n, n))) * n;
  }
}

/// Edges at the corner as vectors of the element's plane.
template <class R>
[[nodiscard]] std::array<SurfaceVectorOf<R>, 2> surface_vectors(AtomShape shape, const std::array<Vec3Of<R>, 3>& e, const Curved& frame) {
  const Vec3Of<R> n = surface_normal(shape, e, frame);
  return {SurfaceVectorOf<R>{e[0], n}, SurfaceVectorOf<R>{e[1], n}};
}

/// Edges at the corner in the coordinates of ElementFrames.
template <class R>
[[nodiscard]] std::array<Vec2<R>, 2> surface_coordinates(AtomShape shape, const std::array<Vec3Of<R>, 3>& e, const Curved& frame) {
  const Vec3Of<R> n = surface_normal(shape, e, frame);
  if constexpr (std::is_same_v<R, double>) {
    const Plane plane = tangent_plane(n);
    return {plane.project(e[0]), plane.project(e[1])};
  } else {
    // Takes as the plane's first direction that of a coordinate, brought into it: the second is at a right angle to that coordinate.
    const Plane plane = tangent_plane({n.x.value, n.y.value, n.z.value});
    const std::array<double, 3> along{plane.u.x - std::fabs(plane.v.x), plane.u.y - std::fabs(plane.v.y), plane.u.z - std::fabs(plane.v.z)};
    std::array<Vec3Of<R>, 3> axes{};
    axes[0].x = axes[1].y = axes[2].z = R(1.0);
    const Vec3Of<R> axis = axes[static_cast<std::size_t>(std::max_element(along.begin(), along.end()) - along.begin())];
    using scalar::sqrt;
    Vec3Of<R> u = axis - dot(axis, n) * n;
    u = (R(1.0) / sqrt(dot(u, u))) * u;
    const Vec3Of<R> v = cross(n, u);
    return {Vec2<R>{dot(e[0], u), dot(e[0], v)}, Vec2<R>{dot(e[1], u), dot(e[1], v)}};
  }
}

/// Twice the area between the edges, positive where the atom is not inverted.
[[nodiscard]] inline double surface_jacobian(AtomShape shape, const AtomEdges<3>& edges, const Curved& frame) {
  const auto e = surface_vectors(shape, plain_vectors(edges), frame);
  return cross(e[0], e[1]);
}

/// See AtomFunction.
template <Metric M>
[[nodiscard]] double inverse_on_surface(AtomShape shape, const AtomEdges<3>& edges, const Curved& frame) {
  const auto e = surface_vectors(shape, plain_vectors(edges), frame);
  const double q = planar_quality<M>(shape == AtomShape::SurfaceTriangle, e[0], e[1]);
  return q > 0.0 && cross(e[0], e[1]) > 0.0 ? 1.0 / q : std::numeric_limits<double>::infinity();
}
template <Metric M>
void derive_inverse_on_surface(AtomShape shape, const AtomEdges<3>& edges, const Curved& frame, Curvature curvature,
                               AtomDerivatives<3>& result) {
  const auto e = surface_vectors(shape, dual_vectors(edges), frame);
  derive_inverse<3>(planar_quality<M>(shape == AtomShape::SurfaceTriangle, e[0], e[1]), curvature, result);
}

}  // namespace dmoscope
