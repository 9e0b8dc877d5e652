#pragma once
// The plane of a planar mesh, and conversions between it and space.

#include <optional>
#include <type_traits>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// The shorter difference from `origin` to `at` on a circle, if it is not the plain one; the two are less than `period` apart. The one
/// farther from 0 is shifted by the period, which rounds nothing near the seam. Always inlined: code for different processors shares it.
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE inline double way_round(double at, double origin, double period) {
  const double round = at > origin ? period : -period;
  return at * at > origin * origin ? (at - round) - origin : at - (origin + round);
}

/// An orthonormal frame (u, v, normal). For a plane z = const, u = x and v = y exactly, so nothing is rounded; for x = const they are (y,
/// z), for y = const (z, x). On a mesh in longitude and latitude that wraps (see seam.h) x is periodic: positions a period apart are one
/// place, and differences are the shortest ones. All judging goes through differences, so elements are judged unwrapped wherever they lie.
struct Plane {
  Vec3 u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
  double period = 0.0;  // 360 for a mesh that wraps, whose u is x; else 0
  double west = 0.0;    // longitude of the file's seam: x lies in [west, west + period]
  double cut = 0.0;     // longitude of the seam in pictures
  /// The shortest vector from `origin` to `at`.
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 difference(Vec3 at, Vec3 origin) const {
    Vec3 way = at - origin;
    if (period > 0.0 && (way.x > 0.5 * period || way.x < -0.5 * period)) way.x = way_round(at.x, origin.x, period);
    return way;
  }
  /// Coordinates of a difference of two positions in the plane. It takes differences only: offsets keep their digits far from the origin.
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> project(Vec3 difference) const { return {dot(difference, u), dot(difference, v)}; }
  /// Coordinates in the plane of the vector from `origin` to `at`.
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> offset(Vec3 at, Vec3 origin) const { return project(difference(at, origin)); }
  /// Coordinates of a position in a picture: those west of the cut come behind all others.
  [[nodiscard]] Vec2<double> place(Vec3 position) const {
    Vec2<double> p = project(position);
    if (period > 0.0 && position.x < cut) p.x += period;
    return p;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 lift(Vec2<double> offset) const { return offset.x * u + offset.y * v; }
};

/// The frame of a volume mesh: all of space, in which offsets are differences of positions.
struct Space {
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 difference(Vec3 at, Vec3 origin) const { return at - origin; }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 offset(Vec3 at, Vec3 origin) const { return at - origin; }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 project(Vec3 difference) const { return difference; }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 lift(Vec3 offset) const { return offset; }
};

/// A vector of a curved surface, whose cross product is measured against a given unit normal.
template <class Real>
struct SurfaceVectorOf {
  Vec3Of<Real> v{}, normal{};
  friend DMOSCOPE_ANYWHERE SurfaceVectorOf operator-(SurfaceVectorOf a, SurfaceVectorOf b) { return {a.v - b.v, b.normal}; }
  friend bool operator==(const SurfaceVectorOf&, const SurfaceVectorOf&) = default;
};
using SurfaceVector = SurfaceVectorOf<double>;
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real dot(SurfaceVectorOf<Real> a, SurfaceVectorOf<Real> b) {
  return dot(a.v, b.v);
}
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real cross(SurfaceVectorOf<Real> a, SurfaceVectorOf<Real> b) {
  return dot(cross(a.v, b.v), b.normal);
}
[[nodiscard]] inline SurfaceVector times(SurfaceVector a, double s) { return {s * a.v, a.normal}; }

/// The frame of a surface mesh: all of space, with elements judged in their own planes.
struct Curved {
  Vec3 normal{};                  // normal for elements that have none
  bool mostly_flat = false;       // quadrilaterals are judged against `normal`: see Geometry
  const Vec3* normals = nullptr;  // normal of each element, see InputMesh::surface_normals; null: none
  bool against = false;           // whether every element is judged against `normal`: one that looks away from it is inverted
  /// The frame of one element, with its normal.
  [[nodiscard]] Curved of(Index element) const { return normals == nullptr ? *this : Curved{normals[element], false, nullptr, true}; }
  [[nodiscard]] SurfaceVector offset(Vec3 at, Vec3 origin) const { return {at - origin, {}}; }
};

/// An offset from a vertex in a frame (Plane, Space or Curved), in whatever scalar computes with it.
template <class Frame, class Real>
using OffsetIn = std::conditional_t<std::is_same_v<Frame, Plane>, Vec2<Real>,
                                    std::conditional_t<std::is_same_v<Frame, Curved>, SurfaceVectorOf<Real>, Vec3Of<Real>>>;

/// Coordinates (0 x, 1 y, 2 z) that u and v of a plane are exactly; -1 and -1 if it is parallel to no coordinate plane. All components
/// count: a plane tilted by 1e-9 has a component of 1, too.
struct PlaneAxes {
  int u = -1, v = -1;
  explicit PlaneAxes(const Plane& plane) {
    const auto axis = [](Vec3 d) { return d == Vec3{1, 0, 0} ? 0 : d == Vec3{0, 1, 0} ? 1 : d == Vec3{0, 0, 1} ? 2 : -1; };
    u = axis(plane.u);
    v = axis(plane.v);
    if (u < 0 || v < 0) u = v = -1;
  }
};

/// The frame with this unit normal that lies nearest to the coordinate plane's own.
[[nodiscard]] Plane tangent_plane(Vec3 normal);

enum class Shape { Planar, Surface, Volume };

/// Kind of a mesh, its plane and size.
struct Geometry {
  Shape shape = Shape::Planar;
  Plane plane;               // plane of a Planar mesh; of a Surface the coordinate plane nearest to the mean normal
  bool mostly_flat = false;  // Surface: most elements are parallel to `plane`, which then gives quadrilaterals their sign
  double deviation = 0.0;    // largest distance of a used vertex from the best plane, in mesh units
  double size = 0.0;         // diagonal of the bounding box of the used vertices
};

/// Twice the area vector of a triangle or quadrilateral: normal to it, which is counter-clockwise seen from its tip. Meaningless for volume
/// elements. `plane`: takes the differences.
[[nodiscard]] Vec3 area_vector(const Mesh& mesh, Index element, const Plane& plane = {});

/// Length of the diagonal of a box. Squares neither underflow nor overflow unless the length itself does.
[[nodiscard]] double diagonal(Vec3 low, Vec3 high);
/// The coordinate plane that a box lies in; none if it extends along x, y and z.
[[nodiscard]] std::optional<Plane> coordinate_plane_of(Vec3 low, Vec3 high);

/// Classifies a mesh. It is planar if no used vertex lies farther than 1e-6 * size from the best plane, whose normal's largest component is
/// positive; a volume mesh as soon as one element is three-dimensional. Never throws; an empty mesh is planar with z normal.
[[nodiscard]] Geometry classify(const Mesh& mesh);

}  // namespace dmoscope
