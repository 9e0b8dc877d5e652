#include "render/camera.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::render {
namespace {

constexpr double kSmallestUnits = 1e-300, kLargestUnits = 1e300;

double sensible(double units) { return std::isfinite(units) ? std::clamp(units, kSmallestUnits, kLargestUnits) : 1.0; }

}  // namespace

void Bounds2::include(Vec2<double> point) noexcept {
  if (empty()) {
    low = high = point;
    return;
  }
  low = {std::min(low.x, point.x), std::min(low.y, point.y)};
  high = {std::max(high.x, point.x), std::max(high.y, point.y)};
}

void Bounds2::include(const Bounds2& other) noexcept {
  if (other.empty()) return;
  include(other.low);
  include(other.high);
}

Camera2D Camera2D::fit(const Bounds2& bounds, Vec2<double> viewport, double margin) {
  Camera2D camera;
  if (bounds.empty()) return camera;
  camera.centre = bounds.centre();
  const double width = std::max(1.0, viewport.x - 2 * margin), height = std::max(1.0, viewport.y - 2 * margin);
  const double units = std::max(bounds.size().x / width, bounds.size().y / height);
  camera.units_per_pixel = units > 0.0 ? sensible(units) : 1.0;
  return camera;
}

void Camera2D::pan(Vec2<double> pixels) {
  centre.x -= pixels.x * units_per_pixel;
  centre.y += pixels.y * units_per_pixel;
}

void Camera2D::zoom_at(Vec2<double> cursor, Vec2<double> viewport, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  // Closer than this, neighbouring doubles of the plane would be pixels apart and the picture would jump.
  const double finest = std::max({std::abs(centre.x), std::abs(centre.y), 1e-280}) * 1e-14;
  const Vec2<double> held = to_plane(cursor, viewport);
  units_per_pixel = std::max(sensible(units_per_pixel / factor), finest);
  const Vec2<double> moved = to_plane(cursor, viewport);
  centre = centre + (held - moved);
}

void Camera2D::look_at(Vec2<double> point, double extent, Vec2<double> viewport) {
  centre = point;
  const double shorter = std::max(1.0, std::min(viewport.x, viewport.y));
  if (extent > 0.0) units_per_pixel = sensible(extent / shorter);
}

Vec2<double> Camera2D::to_plane(Vec2<double> pixel, Vec2<double> viewport) const {
  return {centre.x + (pixel.x - viewport.x / 2) * units_per_pixel, centre.y - (pixel.y - viewport.y / 2) * units_per_pixel};
}

Vec2<double> Camera2D::to_pixel(Vec2<double> point, Vec2<double> viewport) const {
  return {(point.x - centre.x) / units_per_pixel + viewport.x / 2, (centre.y - point.y) / units_per_pixel + viewport.y / 2};
}

Bounds2 Camera2D::visible(Vec2<double> viewport) const {
  const Vec2<double> half{viewport.x / 2 * units_per_pixel, viewport.y / 2 * units_per_pixel};
  return {centre - half, centre + half};
}

Camera2D Camera2D::for_viewport(Vec2<double> from, Vec2<double> to) const {
  Camera2D camera = *this;
  const double ratio = std::max(from.x / std::max(1.0, to.x), from.y / std::max(1.0, to.y));
  camera.units_per_pixel = sensible(units_per_pixel * ratio);
  return camera;
}

}  // namespace dmoscope::render
