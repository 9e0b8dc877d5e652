#pragma once
// A view of a plane from straight above.

#include "core/base/vec.h"

namespace dmoscope::render {

/// Box in coordinates of the mesh's plane. Empty when high < low.
struct Bounds2 {
  Vec2<double> low{0, 0}, high{-1, -1};
  [[nodiscard]] bool empty() const noexcept { return high.x < low.x || high.y < low.y; }
  [[nodiscard]] Vec2<double> centre() const noexcept { return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2}; }
  [[nodiscard]] Vec2<double> size() const noexcept { return {high.x - low.x, high.y - low.y}; }
  void include(Vec2<double> point) noexcept;
  void include(const Bounds2& other) noexcept;
};

/// Plane coordinates: Plane::project of a position (for z = const just x and y), y up.
/// Pixels: (0, 0) is the left upper corner of the viewport, y down; pixel (i, j)'s centre is (i + 0.5, j + 0.5).
struct Camera2D {
  Vec2<double> centre{0, 0};     // point of the plane in the middle of the viewport
  double units_per_pixel = 1.0;  // > 0

  /// Shows all of `bounds` with at least `margin` pixels around it. Empty or single-point bounds give a sensible view.
  [[nodiscard]] static Camera2D fit(const Bounds2& bounds, Vec2<double> viewport, double margin = 24.0);
  /// Moves the picture by a number of pixels (a drag of the mouse).
  void pan(Vec2<double> pixels);
  /// Makes everything `factor` times as big (> 1: closer); the point under `cursor` stays there. Limits keep it finite.
  void zoom_at(Vec2<double> cursor, Vec2<double> viewport, double factor);
  /// Moves `point` to the middle and shows about `extent` units around it in the viewport's shorter side.
  void look_at(Vec2<double> point, double extent, Vec2<double> viewport);
  [[nodiscard]] Vec2<double> to_plane(Vec2<double> pixel, Vec2<double> viewport) const;
  [[nodiscard]] Vec2<double> to_pixel(Vec2<double> point, Vec2<double> viewport) const;
  /// The part of the plane that a viewport shows.
  [[nodiscard]] Bounds2 visible(Vec2<double> viewport) const;
  /// The camera that shows at least the same part of the plane in a viewport of another size (for screenshots).
  [[nodiscard]] Camera2D for_viewport(Vec2<double> from, Vec2<double> to) const;
  friend constexpr bool operator==(const Camera2D& a, const Camera2D& b) {
    return a.centre.x == b.centre.x && a.centre.y == b.centre.y && a.units_per_pixel == b.units_per_pixel;
  }
};

}  // namespace dmoscope::render
