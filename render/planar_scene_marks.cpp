// What is marked on top of the elements.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {
namespace {

constexpr std::size_t kMostDots = 20'000;  // beyond, dots would hide the mesh anyway

}  // namespace

void PlanarScene::Impl::outline(std::span<const Vec2<double>> corners, const Camera2D& camera, const Style& style) {
  for (const bool casing : {true, false}) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2<double> a = place(corners[i], camera), b = place(corners[(i + 1) % corners.size()], camera);
      marks.line(a, b, (casing ? 5.0F : 2.4F) * style.scale, casing ? style.casing_colour : style.highlight_colour);
    }
  }
}

/// Marks of elements and vertices; their places are asked for all together.
void PlanarScene::Impl::gather_mesh_marks(const Camera2D& camera, const Style& style, const Marks& wanted) {
  const Layout& layout = placement.layout();
  std::vector<std::span<const Index>> shapes;  // outlined elements, and last the worst
  for (const Index e : wanted.elements) {
    if (e < layout.element_count()) shapes.push_back(layout.corners_of(e));
  }
  const std::size_t outlined = shapes.size();
  if (wanted.worst && *wanted.worst < layout.element_count()) shapes.push_back(layout.corners_of(*wanted.worst));
  std::vector<Index> vertices;
  for (const auto& shape : shapes) vertices.insert(vertices.end(), shape.begin(), shape.end());
  const std::size_t corner_count = vertices.size();
  std::copy_if(wanted.vertices.begin(), wanted.vertices.end(), std::back_inserter(vertices),
               [&](Index v) { return v < layout.vertex_count; });
  std::vector<Vec2<double>> points = points_of(vertices);
  // One that lies across the seam of a mesh that wraps is outlined at the end of the picture where its first corner is.
  std::size_t first = 0;
  for (const auto& shape : shapes) {
    for (std::size_t k = first + 1; k < first + shape.size() && layout.plane.period > 0.0; ++k)
      points[k] = points[first] + layout.plane.offset(layout.plane.lift(points[k]), layout.plane.lift(points[first]));
    first += shape.size();
  }
  std::span<const Vec2<double>> rest(points.data(), corner_count);
  for (std::size_t k = 0; k < outlined; ++k) {
    outline(rest.first(shapes[k].size()), camera, style);
    rest = rest.subspan(shapes[k].size());
  }
  for (std::size_t k = corner_count; k < points.size(); ++k) {
    marks.dot(place(points[k], camera), 9.0F * style.scale, DotShape::Round, style.highlight_colour, style.casing_colour);
  }
  if (shapes.size() > outlined) {
    Bounds2 box;
    for (const Vec2<double>& corner : rest) box.include(corner);
    const double size = std::hypot(box.size().x, box.size().y) / camera.units_per_pixel;
    const float diameter = std::max(26.0F * style.scale, static_cast<float>(std::min(size, 1e5)) * 1.15F + 8.0F * style.scale);
    marks.dot(place(box.centre(), camera), diameter, DotShape::Ring, style.highlight_colour, style.casing_colour);
  }
}

void PlanarScene::Impl::gather_marks(const Camera2D& camera, const Style& style, const Marks& wanted) {
  try {
    if (!placement.empty() && source != Source::Unreachable) gather_mesh_marks(camera, style, wanted);
  } catch (const DeviceError&) {  // unmarked; the next frame finds out what is the matter
  }
  for (const OverlayLine& line : wanted.lines) {
    marks.line(place(line.from, camera), place(line.to, camera), line.width * style.scale, line.colour);
  }
  for (const OverlayDot& dot : wanted.dots) {
    marks.dot(place(dot.point, camera), dot.diameter * style.scale, dot.shape, dot.colour, style.casing_colour);
  }
}

void PlanarScene::Impl::gather_vertices(const Camera2D& camera, const Style& style, const Bounds2& window) {
  try {
    place_all();
  } catch (const DeviceError&) {  // no dots; the next frame finds out what is the matter
    return;
  }
  // Vertices of elements in view that are big enough, each once.
  const double room = 14.0 * static_cast<double>(style.scale) * camera.units_per_pixel;
  std::vector<Index> seen;
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements_of = placement.layout().batches[batch];
    for (const DrawRange& range : placement.visible(batch, window)) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        if (hidden(elements_of.order[drawn])) continue;
        const auto corners = placement.layout().corners_of(elements_of.order[drawn]);
        const Vec2<double> a = placement.points()[corners[0]], b = placement.points()[corners[1]], c = placement.points()[corners[2]];
        if (std::abs(cross(b - a, c - a)) < room * room) continue;
        seen.insert(seen.end(), corners.begin(), corners.end());
        if (seen.size() > 6 * kMostDots) return;
      }
    }
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (seen.size() > kMostDots) return;
  for (const Index v : seen) {
    const bool is_fixed = v < fixed.size() && fixed[v] != 0;
    marks.dot(place(placement.points()[v], camera), (is_fixed ? 5.0F : 4.5F) * style.scale, is_fixed ? DotShape::Square : DotShape::Round,
              is_fixed ? style.fixed_colour : style.free_colour, style.vertex_casing_colour);
  }
}

}  // namespace dmoscope::render
