// Places of the marks of a planar mesh.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/mark_painter.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {
namespace {

constexpr Index kMostInView = 60'000;  // elements, as blocks tell: few are looked at however big the mesh is

}  // namespace

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
