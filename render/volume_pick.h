#pragma once
// Finds the part of a volume mesh under a pixel, and which parts hide others. No OpenGL.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/clipping/clipping.h"
#include "render/orbit_camera.h"
#include "render/scene.h"

namespace dmoscope::render {

/// The visible part of a mesh.
struct SeenFaces {
  const ElementTable& elements;
  std::span<const Vec3> positions;
  const ClippedFaces& faces;
  const ClippingView& view;
  std::span<const std::uint8_t> cells{}, vertices{};  // 1 unless taken away; empty: not known, none is taken away
  [[nodiscard]] bool has_cell(Index cell) const { return cells.empty() || cells[cell] != 0; }
  [[nodiscard]] bool has_vertex(Index vertex) const;
};

/// Corners of a face at the places where they are drawn.
struct DrawnFace {
  std::array<Vec3, 4> points;
  std::array<Index, 4> vertices;
  std::size_t count;  // 3 or 4
  [[nodiscard]] std::span<const Vec3> corners() const { return {points.data(), count}; }
};
[[nodiscard]] DrawnFace drawn_face(const SeenFaces& seen, ElementFace face);
/// A point on a polygon as drawn: for a quadrilateral on the diagonal that splits it into two triangles, for a triangle its mean.
[[nodiscard]] Vec3 point_on(std::span<const Vec3> polygon);
/// Whether a plane that cuts through cells leaves out this point of one.
[[nodiscard]] bool cut_away(const SeenFaces& seen, Vec3 point);

/// The nearest face or cut along a ray.
struct RayHit {
  Index element = kNoIndex;
  std::optional<ElementFace> face;  // none: a cut
  double along = 0.0;
};
[[nodiscard]] std::optional<RayHit> first_hit(const SeenFaces& seen, const ViewRay& ray);

/// Whether some part of a cell's drawing is not behind others: looks at the middles of its faces and cuts and half way to their corners,
/// with a ray for each of these places, until one is seen.
[[nodiscard]] bool is_unhidden(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Index cell);

/// Element and vertex under a pixel, see VolumeScene::pick. `bounds`: box of the mesh.
[[nodiscard]] Pick pick(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel,
                        double radius);

/// Drawn position of an element's vertex: shrunk towards the mean of the element's vertices.
[[nodiscard]] Vec3 drawn_corner(const SeenFaces& seen, Index element, Index vertex);

/// A coarse picture of the depths of all that is drawn, to tell which points lie behind it.
class DepthMap {
 public:
  DepthMap(const SeenFaces& seen, const Projection& projection);
  /// Whether a point is in view and no face lies in front of it. A point little behind a face counts as on it, and so does one that only a
  /// pixel or two of the map hide.
  [[nodiscard]] bool shows(Vec3 point) const;
  [[nodiscard]] const Projection& projection() const noexcept { return projection_; }

 private:
  struct Corner {
    double x, y, depth;  // pixels of the map, from its left lower corner
  };
  [[nodiscard]] std::optional<Corner> corner(Vec3 point) const;
  [[nodiscard]] double depth_of_a_pixel() const;
  void draw(std::span<const Vec3> polygon);
  void draw(const Corner& a, const Corner& b, const Corner& c);

  Projection projection_;
  double scale_;  // pixels of the map per pixel of the picture
  double slack_;  // tolerance of depths: a vertex lies on the faces around it
  int width_, height_;
  std::vector<float> depths_;  // row after row from below; infinite where nothing is
};

/// See Scene::unhidden.
[[nodiscard]] Unhidden unhidden_of(const SeenFaces& seen, const DepthMap& depths);

}  // namespace dmoscope::render
