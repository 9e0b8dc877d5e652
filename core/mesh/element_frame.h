#pragma once
// Corners of an element in the frame that it is judged in.

#include <array>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

[[nodiscard]] inline Vec3 unit_normal(Vec3 a, Vec3 b, Vec3 fallback) {
  const Vec3 n = cross(a, b);
  const double l = length(n);
  return l > 0.0 ? (1.0 / l) * n : fallback;
}

/// The unit normal of an element of a curved mesh, from two of its edges or diagonals. With `against`, an element that looks away from
/// `frame_normal` gets that one: its areas, seen from above, are negative and go to 0 as it turns.
[[nodiscard]] inline Vec3 curved_normal(Vec3 a, Vec3 b, Vec3 frame_normal, bool against) {
  const Vec3 n = unit_normal(a, b, frame_normal);
  return against && dot(n, frame_normal) < 0.0 ? frame_normal : n;
}

/// Frames in which the elements of a mesh are judged. A view: the geometry must outlive it.
struct ElementFrames {
  const Geometry& geometry;
  std::span<const Vec3> normals{};  // unit normals of a surface's elements, see InputMesh::surface_normals

  /// Gathers the corners as (x, y, z): those of a planar element relative to its first, in the mesh's plane (z = 0); those of a surface
  /// element relative to its first, in the element's own plane; those of a volume element as they are. at(vertex): its position. Returns
  /// that plane.
  template <class At>
  Plane gather(std::span<const Index> corners, Index element, int dimension, const At& at, std::array<Vec3, 8>& out) const {
    if (dimension == 3) {
      for (std::size_t i = 0; i < corners.size(); ++i) out[i] = at(corners[i]);
      return {};
    }
    const Vec3 origin = at(corners[0]);
    if (geometry.shape == Shape::Planar) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2<double> p = geometry.plane.offset(at(corners[i]), origin);
        out[i] = {p.x, p.y, 0.0};
      }
      return geometry.plane;
    }
    std::array<Vec3, 4> way{};
    for (std::size_t i = 0; i < corners.size(); ++i) way[i] = at(corners[i]) - origin;
    const bool against = !normals.empty();
    const Vec3 above = against ? normals[element] : geometry.plane.normal;
    const bool given = corners.size() == 4 && geometry.mostly_flat && !against;
    const Vec3 normal = given                 ? above
                        : corners.size() == 3 ? curved_normal(way[1], way[2], above, against)
                                              : curved_normal(way[2], way[3] - way[1], above, against);
    const Plane plane = tangent_plane(normal);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2<double> p = plane.project(way[i]);
      out[i] = {p.x, p.y, 0.0};
    }
    return plane;
  }
};

}  // namespace dmoscope
