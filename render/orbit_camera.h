#pragma once
// A view of a volume mesh from any side. Plain data and mathematics in double; no OpenGL.

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/vec.h"

namespace dmoscope::render {

/// Box along the axes. Empty when high < low.
struct Bounds3 {
  Vec3 low{0, 0, 0}, high{-1, -1, -1};
  [[nodiscard]] bool empty() const noexcept { return high.x < low.x; }
  [[nodiscard]] Vec3 centre() const noexcept { return low + 0.5 * (high - low); }
  /// Radius of the ball around the box; 0 when the box is empty.
  [[nodiscard]] double radius() const noexcept { return empty() ? 0.0 : 0.5 * length(high - low); }
  void include(Vec3 point) noexcept;
};

/// Directions to look from.
enum class ViewPreset { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ, Isometric };
struct ViewPresetInfo {
  ViewPreset preset;
  std::string_view name;  // "+x", as on the command line
};
[[nodiscard]] std::span<const ViewPresetInfo> view_preset_table();
/// Preset of this name. Throws UsageError that lists the names.
[[nodiscard]] ViewPreset view_preset_from_name(std::string_view name);

/// Points of the mesh that lie under a pixel: from + t * direction, t >= first; the nearest has the least t. `direction` is of length 1.
struct ViewRay {
  Vec3 from, direction;
  double first = -std::numeric_limits<double>::infinity();
};

/// Part of a picture, in pixels of the whole.
struct PicturePart {
  Vec2<double> low, high;
};

/// Maps positions of the mesh to a picture.
class Projection {
 public:
  /// Maps positions relative to origin() to clip coordinates; column after column.
  [[nodiscard]] const std::array<double, 16>& matrix() const noexcept { return matrix_; }
  [[nodiscard]] Vec3 origin() const noexcept { return origin_; }
  [[nodiscard]] Vec2<double> viewport() const noexcept { return viewport_; }  // size of the part, in pixels
  /// Pixels from the middle of the viewport, y up; none for points behind the eye.
  [[nodiscard]] std::optional<Vec2<double>> place(Vec3 point) const;
  /// Measure of the distance from the eye, in no particular unit: less is nearer.
  [[nodiscard]] double depth(Vec3 point) const;

 private:
  friend struct OrbitCamera;
  std::array<double, 16> matrix_{};
  Vec3 origin_;
  Vec2<double> viewport_;
};

/// The axis that points up when a mesh in space is turned or seen from the side.
enum class UpAxis { Z, Y };

/// A camera that turns about a centre. Pixels as those of Camera2D: (0, 0) is the left upper corner of the viewport.
struct OrbitCamera {
  static constexpr double kFieldOfView = 0.5235987755982988;  // 30 degrees, from the lower to the upper border

  Vec3 centre{0, 0, 0};              // point in the middle of the viewport, about which the camera turns
  double height = 1.0;               // units from the lower to the upper border of the viewport, at the centre; > 0
  Vec3 right{1, 0, 0}, up{0, 1, 0};  // orthonormal directions
  bool perspective = false;
  UpAxis up_axis = UpAxis::Z;
  friend bool operator==(const OrbitCamera&, const OrbitCamera&) = default;

  [[nodiscard]] Vec3 back() const { return cross(right, up); }
  /// Distance of the eye from the centre; the orthographic view uses that of the perspective one.
  [[nodiscard]] double distance() const;
  [[nodiscard]] Vec3 eye() const { return centre + distance() * back(); }
  [[nodiscard]] double units_per_pixel(Vec2<double> viewport) const { return height / viewport.y; }

  /// Whether its numbers make a view: the height is greater than 0, and the directions are orthonormal up to rounding.
  [[nodiscard]] bool is_valid() const;
  [[nodiscard]] Vec3 upright() const { return up_axis == UpAxis::Z ? Vec3{0, 0, 1} : Vec3{0, 1, 0}; }
  /// Looks at the same centre from the preset's direction, upright; along the upright axis, y is up when looking along z, and -z when
  /// looking along y.
  void look_from(ViewPreset preset);
  /// Turns to face a surface along `outward`, unless it is seen well enough from here; upright as look_from().
  void face(Vec3 outward);
  /// Shows all of `points` within that part of the viewport, as large as can be: they reach two opposite borders of it, and are in the
  /// middle between the other two. The centre lies half-way into their depth. No or a single point gives a sensible view.
  void fit(std::span<const Vec3> points, Vec2<double> viewport, const PicturePart& room);
  /// Shows all corners of a box, with `margin` pixels around it, as the other fit() does.
  void fit(const Bounds3& bounds, Vec2<double> viewport, double margin = 24.0);
  /// Turns by a drag of a number of pixels: sideways about the upright axis, and up and down until straight above or below.
  void turn(Vec2<double> pixels, Vec2<double> viewport);
  /// Turns by a drag from one pixel to another as if the mesh were a ball that fills the viewport.
  void roll(Vec2<double> from, Vec2<double> to, Vec2<double> viewport);
  void pan(Vec2<double> pixels, Vec2<double> viewport);
  /// Makes everything `factor` times as big (> 1: closer); the point under `cursor` at the centre's depth stays there.
  void zoom_at(Vec2<double> cursor, Vec2<double> viewport, double factor);
  /// Makes another axis the upright one: looks at the mesh as before, as if it had been turned that way.
  void raise(UpAxis axis);
  /// Moves `point` to the middle: the camera turns about it from now on.
  void orbit_about(Vec3 point) { centre = point; }

  [[nodiscard]] ViewRay ray(Vec2<double> pixel, Vec2<double> viewport) const;
  /// Projection of positions relative to the centre of `bounds`, all of which has a depth in range. `part`: none for the whole viewport.
  [[nodiscard]] Projection projection(Vec2<double> viewport, const Bounds3& bounds, const std::optional<PicturePart>& part = {}) const;
};

}  // namespace dmoscope::render
