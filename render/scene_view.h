#pragma once
// Maps points of a scene to a picture of it, whichever kind of mesh it shows. Plain mathematics in double; no OpenGL.

#include <optional>
#include <variant>

#include "render/camera.h"
#include "render/orbit_camera.h"

namespace dmoscope::render {

/// A view: Camera2D of a planar mesh, OrbitCamera of a volume or a curved surface.
using Camera = std::variant<Camera2D, OrbitCamera>;

/// A point of a plane as a point of its scene.
[[nodiscard]] inline Vec3 in_scene(Vec2<double> point) { return {point.x, point.y, 0.0}; }

/// A scene seen by a camera. Its points are those of the mesh's space, or for a planar mesh those of its plane, with z = 0.
class SceneView {
 public:
  /// View from straight above a plane.
  SceneView(const Camera2D& camera, Vec2<double> viewport) : viewport_(viewport), plane_(camera) {}
  SceneView(const OrbitCamera& camera, const Projection& projection)
      : viewport_(projection.viewport()), orbit_(camera), projection_(projection) {}

  [[nodiscard]] Vec2<double> viewport() const noexcept { return viewport_; }
  /// Pixels from the middle of the picture, y up; none for points behind the eye.
  [[nodiscard]] std::optional<Vec2<double>> place(Vec3 point) const;
  /// Pixels between the places of two points; 0 when one is behind the eye.
  [[nodiscard]] double pixels(Vec3 a, Vec3 b) const;
  /// Upper limit of the number of pixels that a way of this length takes anywhere in the picture.
  [[nodiscard]] double most_pixels(double length) const;
  /// Measure of the distance from the eye, in no particular unit: less is nearer. 0 in a plane.
  [[nodiscard]] double depth(Vec3 point) const { return plane_ ? 0.0 : projection_.depth(point); }
  /// Units per pixel at the middle of the view.
  [[nodiscard]] double units_per_pixel() const;
  /// Whether the point is within the picture.
  [[nodiscard]] bool holds(Vec3 point) const;
  /// Whether some of the box around a line is within the picture.
  [[nodiscard]] bool meets(Vec3 a, Vec3 b) const;
  /// Vector from the middle of an arrow's head to one of its ends, for an arrow along `way`: it lies flat before the eye, and the head is
  /// as broad as `back` is long.
  [[nodiscard]] Vec3 across(Vec3 way, Vec3 back) const;

 private:
  Vec2<double> viewport_;
  std::optional<Camera2D> plane_;  // none: a view in space
  OrbitCamera orbit_;
  Projection projection_;
};

}  // namespace dmoscope::render
