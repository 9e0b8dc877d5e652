#pragma once
// Which part of a volume mesh lies under a pixel. No OpenGL.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/clipping/clipping.h"
#include "render/orbit_camera.h"
#include "render/scene.h"

namespace dmoscope::render {

/// The part of a mesh that is seen.
struct SeenFaces {
  const ElementTable& elements;
  std::span<const Vec3> positions;
  const ClippedFaces& faces;
  const ClippingView& view;
  std::span<const std::uint8_t> cells{}, vertices{};  // 1 for those that are not taken away; empty: not known, so none is
  [[nodiscard]] bool has_cell(Index cell) const { return cells.empty() || cells[cell] != 0; }
  [[nodiscard]] bool has_vertex(Index vertex) const;
};

/// A face's corners where they are drawn.
struct DrawnFace {
  std::array<Vec3, 4> points;
  std::array<Index, 4> vertices;
  std::size_t count;  // 3 or 4
  [[nodiscard]] std::span<const Vec3> corners() const { return {points.data(), count}; }
};
[[nodiscard]] DrawnFace drawn_face(const SeenFaces& seen, ElementFace face);
/// A point where a polygon is drawn: of a quadrilateral on the diagonal along which it is two triangles, of a triangle its mean.
[[nodiscard]] Vec3 point_on(std::span<const Vec3> polygon);
/// Whether a plane that cuts cells through leaves this point of one out.
[[nodiscard]] bool cut_away(const SeenFaces& seen, Vec3 point);

/// The nearest face or cut along a ray.
struct RayHit {
  Index element = kNoIndex;
  std::optional<ElementFace> face;  // none: a cut
  double along = 0.0;
};
[[nodiscard]] std::optional<RayHit> first_hit(const SeenFaces& seen, const ViewRay& ray);

/// Whether some place of what is drawn of a cell, looked at in the middles of its faces and cuts and half way to their corners, is not
/// behind others. A ray for each of these places, until one is seen.
[[nodiscard]] bool is_unhidden(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Index cell);

/// See VolumeScene::pick. `bounds`: of the mesh.
[[nodiscard]] Pick pick(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel,
                        double radius);

/// Where a vertex of an element is drawn: shrunk about the mean of the element's vertices.
[[nodiscard]] Vec3 drawn_corner(const SeenFaces& seen, Index element, Index vertex);

}  // namespace dmoscope::render
