#pragma once
// From the points of a scene to a picture of it, whichever kind of mesh it shows. Plain mathematics in double; no OpenGL.

#include <optional>
#include <variant>

#include "render/camera.h"
#include "render/orbit_camera.h"

namespace dmoscope::render {

/// Camera2D: of a planar mesh; OrbitCamera: of a volume or a curved surface.
using Camera = std::variant<Camera2D, OrbitCamera>;

/// A point of a plane as a point of its scene.
[[nodiscard]] inline Vec3 in_scene(Vec2<double> point) { return {point.x, point.y, 0.0}; }

/// A scene as it is seen. Its points are those of the mesh's space, or of a planar mesh those of its plane, whose z is 0.
class SceneView {
 public:
  /// Straight above a plane.
  SceneView(const Camera2D& camera, Vec2<double> viewport) : viewport_(viewport), plane_(camera) {}
  SceneView(const OrbitCamera& camera, const Projection& projection)
      : viewport_(projection.viewport()), orbit_(camera), projection_(projection) {}

  [[nodiscard]] Vec2<double> viewport() const noexcept { return viewport_; }
  /// Pixels from the middle of the picture, y up; none for what lies behind the eye.
  [[nodiscard]] std::optional<Vec2<double>> place(Vec3 point) const;
  /// Between the places of two points; 0 where one is behind the eye.
  [[nodiscard]] double pixels(Vec3 a, Vec3 b) const;
  /// Upper limit of the pixels that a way of this length takes, wherever it is.
  [[nodiscard]] double most_pixels(double length) const;
  /// How far from the eye: less is nearer, whatever the unit.
  [[nodiscard]] double depth(Vec3 point) const { return plane_ ? 0.0 : projection_.depth(point); }
  /// At the middle of what is seen.
  [[nodiscard]] double units_per_pixel() const;
  /// Whether the point is within the picture.
  [[nodiscard]] bool holds(Vec3 point) const;
  /// Whether the box around a line has something within the picture.
  [[nodiscard]] bool meets(Vec3 a, Vec3 b) const;
  /// From the middle of an arrow's head to one of its ends, for an arrow along `way`: it lies flat before the eye, and the head is as broad
  /// as `back` is long.
  [[nodiscard]] Vec3 across(Vec3 way, Vec3 back) const;

 private:
  Vec2<double> viewport_;
  std::optional<Camera2D> plane_;  // none: in space
  OrbitCamera orbit_;
  Projection projection_;
};

}  // namespace dmoscope::render
