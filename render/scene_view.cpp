#include "render/scene_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmoscope::render {

std::optional<Vec2<double>> SceneView::place(Vec3 point) const {
  if (!plane_) return projection_.place(point);
  return Vec2<double>{(point.x - plane_->centre.x) / plane_->units_per_pixel, (point.y - plane_->centre.y) / plane_->units_per_pixel};
}

double SceneView::pixels(Vec3 a, Vec3 b) const {
  const auto p = place(a), q = place(b);
  return p && q ? std::hypot(q->x - p->x, q->y - p->y) : 0.0;
}

double SceneView::most_pixels(double length) const {
  return !plane_ && orbit_.perspective ? std::numeric_limits<double>::infinity() : length / units_per_pixel();
}

double SceneView::units_per_pixel() const { return plane_ ? plane_->units_per_pixel : orbit_.units_per_pixel(viewport_); }

bool SceneView::holds(Vec3 point) const { return meets(point, point); }

bool SceneView::meets(Vec3 a, Vec3 b) const {
  const auto p = place(a), q = place(b);
  if (!p || !q) return false;
  const Vec2<double> half{0.5 * viewport_.x, 0.5 * viewport_.y};
  return std::max(p->x, q->x) >= -half.x && std::min(p->x, q->x) <= half.x && std::max(p->y, q->y) >= -half.y &&
         std::min(p->y, q->y) <= half.y;
}

Vec3 SceneView::across(Vec3 way, Vec3 back) const {
  const Vec3 across = cross(way, plane_ ? Vec3{0, 0, 1} : orbit_.back());
  const double size = length(across);
  return size > 0.0 ? 0.5 * length(back) / size * across : Vec3{};
}

}  // namespace dmoscope::render
