#pragma once
// Finds which parts of a volume mesh hide others, without OpenGL. Only for sources of this module.

#include <span>
#include <vector>

#include "render/orbit_camera.h"
#include "render/volume_pick.h"

namespace dmoscope::render {

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
