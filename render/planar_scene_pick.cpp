// Finds elements and vertices in a viewport.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/planar_scene_impl.h"

namespace dmoscope::render {
namespace {

constexpr Index kMostInView = 60'000;  // elements, as blocks tell: few are looked at however big the mesh is

}  // namespace

Pick PlanarScene::pick(const Camera& seen_from, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  Pick result;
  const Impl& s = *impl_;
  if (!impl_->is_known()) return result;
  const Layout& layout = s.placement.layout();
  const auto points = s.placement.points();
  const Vec2<double> point = camera.to_plane(pixel, viewport);
  const double reach = std::max(radius, 0.0) * camera.units_per_pixel;
  double nearest = reach * reach;
  bool on_top = false;
  for_elements({{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}}, [&](Index element) {
    const auto corners = layout.corners_of(element);
    for (const Index v : corners) {
      const Vec2<double> away = points[v] - point;
      const double square = dot(away, away);
      if (square < nearest || (square == nearest && v < result.vertex)) {
        nearest = square;
        result.vertex = v;
      }
    }
    if (layout.is_across(corners, points) || !contains(corners, points, point)) return;
    const bool inverted = element < s.shades.size() && s.shades[element] == kInvertedShade;
    if (on_top && !inverted) return;  // the later one covers the earlier one, but no inverted one
    result.element = element;
    on_top = inverted;
  });
  result.vertex_distance = std::sqrt(nearest) / camera.units_per_pixel;
  return result;
}

std::vector<Index> PlanarScene::vertices_near(const Camera2D& camera, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  std::vector<Index> found;
  if (!impl_->is_known()) return found;
  const Vec2<double> point = camera.to_plane(pixel, viewport);
  const double reach = radius * camera.units_per_pixel;
  for_elements({{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}}, [&](Index element) {
    for (const Index v : impl_->placement.layout().corners_of(element)) {
      const Vec2<double> away = impl_->placement.points()[v] - point;
      if (dot(away, away) <= reach * reach) found.push_back(v);
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<Unhidden> PlanarScene::unhidden(const Camera& camera, Vec2<double> viewport) const {
  Unhidden seen;
  if (empty()) return seen;
  const Bounds2 window = std::get<Camera2D>(camera).visible(viewport);
  if (!impl_->is_known() || impl_->in_view(window).count > kMostInView) return std::nullopt;
  for_elements(window, [&](Index element) {
    const auto corners = impl_->placement.layout().corners_of(element);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      seen.vertices.push_back(a);
      seen.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  });
  seen.tidy();
  return seen;
}

void PlanarScene::visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const {
  const Bounds2 window = std::get<Camera2D>(camera).visible(viewport);
  if (empty() || !impl_->is_known() || impl_->in_view(window).count > kMostInView) return;
  const auto points = impl_->placement.points();
  std::array<Vec3, 4> polygon;
  for_elements(window, [&](Index element) {
    const auto corners = impl_->placement.layout().corners_of(element);
    if (impl_->placement.layout().is_across(corners, points)) return;
    std::ranges::transform(corners, polygon.begin(), [&](Index v) { return in_scene(points[v]); });
    visit(element, std::span(polygon).first(corners.size()));
  });
}

}  // namespace dmoscope::render
