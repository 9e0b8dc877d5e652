// Places of the marks of a planar mesh.
#include <algorithm>
#include <cmath>

#include "render/mark_painter.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {

const ElementTable* PlanarScene::elements() const {
  return impl_->placement.empty() || impl_->source == Source::Unreachable ? nullptr : &impl_->placement.layout().mesh->elements;
}

Index PlanarScene::vertex_count() const { return impl_->placement.layout().vertex_count; }

std::vector<Vec3> PlanarScene::places_of(std::span<const Corner> corners) const {
  const Plane& plane = impl_->placement.layout().plane;
  std::vector<Index> vertices(corners.size());
  std::ranges::transform(corners, vertices.begin(), &Corner::vertex);
  const std::vector<Vec2<double>> points = impl_->points_of(vertices);
  std::vector<Vec3> places;
  places.reserve(points.size());
  std::size_t first = 0;  // index of the corner within the element
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k].element == kNoIndex || corners[k].element != corners[first].element) first = k;
    // An element across the seam of a mesh that wraps is marked at the end of the picture where its first corner is.
    const bool beside = plane.period > 0.0 && k != first;
    places.push_back(in_scene(beside ? points[first] + plane.offset(plane.lift(points[k]), plane.lift(points[first])) : points[k]));
  }
  return places;
}

void PlanarScene::gather_vertices(const SceneView& view, const Style& style, const Bounds2& window) {
  constexpr std::size_t kMostDots = 20'000;  // beyond, dots would hide the mesh anyway
  if (!impl_->is_known()) return;
  const auto points = impl_->placement.points();
  const double room = 14.0 * static_cast<double>(style.scale) * view.units_per_pixel();
  std::vector<Index> seen;
  for_elements(window, [&](Index element) {
    const auto corners = impl_->placement.layout().corners_of(element);
    const Vec2<double> a = points[corners[0]], b = points[corners[1]], c = points[corners[2]];
    if (seen.size() > 6 * kMostDots || std::abs(cross(b - a, c - a)) < room * room) return;
    seen.insert(seen.end(), corners.begin(), corners.end());
  });
  if (seen.size() > 6 * kMostDots) return;
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (seen.size() > kMostDots) return;
  for (const Index v : seen) {
    const bool is_fixed = v < impl_->fixed.size() && impl_->fixed[v] != 0;
    painter().dot(*view.place(in_scene(points[v])), (is_fixed ? 5.0F : 4.5F) * style.scale, is_fixed ? DotShape::Square : DotShape::Round,
                  is_fixed ? style.fixed_colour : style.free_colour, style.vertex_casing_colour);
  }
}

}  // namespace dmoscope::render
