// Marks on top of the elements.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/mesh/element_edges.h"
#include "render/framebuffer.h"
#include "render/mark_painter.h"
#include "render/scene.h"
#include "render/triad.h"

namespace dmoscope::render {
namespace {

void line(const SceneView& view, Vec3 from, Vec3 to, float width, Rgba colour, MarkPainter& painter) {
  const auto a = view.place(from), b = view.place(to);
  if (a && b) painter.line(*a, *b, width, colour);
}

/// Colours of marks: faint when what they mark was taken away.
struct Inks {
  Inks(const Style& style, bool there) : highlight(style.highlight_colour), casing(style.casing_colour) {
    if (there) return;
    highlight.a = static_cast<std::uint8_t>(highlight.a * 3 / 8);
    casing.a = static_cast<std::uint8_t>(casing.a / 4);
  }
  Rgba highlight, casing;
};

/// Draws all edges of an element whose corners are drawn at `points`.
void outline(const ElementTable& elements, Index element, std::span<const Vec3> points, const SceneView& view, const Style& style,
             const Inks& inks, MarkPainter& painter) {
  for (const bool casing : {true, false})
    for_edges(elements.kind(element), [&](Index a, Index b) {
      line(view, points[a], points[b], (casing ? 4.4F : 2.0F) * style.scale, casing ? inks.casing : inks.highlight, painter);
    });
}

void ring(std::span<const Vec3> points, const SceneView& view, const Style& style, const Inks& inks, MarkPainter& painter) {
  Bounds2 box;
  for (const Vec3& point : points) {
    const auto place = view.place(point);
    if (!place) return;
    box.include(*place);
  }
  const double size = std::hypot(box.size().x, box.size().y);
  const float diameter = std::max(26.0F * style.scale, static_cast<float>(std::min(size, 1e5)) * 1.15F + 8.0F * style.scale);
  painter.dot(box.centre(), diameter, DotShape::Ring, inks.highlight, inks.casing);
}

}  // namespace

/// Gathers marks of elements and vertices; their places are asked for all together.
void Scene::gather_of_mesh(const SceneView& view, const Style& style, const Marks& wanted) {
  const ElementTable* table = elements();
  if (table == nullptr) return;
  const auto inks = [&](bool there) { return Inks(style, there || !wanted.faint_where_taken_away); };
  std::vector<Corner> corners;
  const auto add = [&](Index element) {
    for (const Index v : table->corners(element)) corners.push_back({element, v});
  };
  std::vector<Index> outlined;
  std::ranges::copy_if(wanted.elements, std::back_inserter(outlined), [&](Index e) { return e < table->size(); });
  std::ranges::for_each(outlined, add);
  const bool has_worst = wanted.worst && *wanted.worst < table->size();
  if (has_worst) add(*wanted.worst);
  const std::size_t of_elements = corners.size();
  for (const Index v : wanted.vertices)
    if (v < vertex_count()) corners.push_back({kNoIndex, v});
  const std::vector<Vec3> points = places_of(corners);
  std::span<const Vec3> rest(points);
  for (const Index e : outlined) {
    const std::size_t count = table->corners(e).size();
    outline(*table, e, rest.first(count), view, style, inks(sees_element(e)), *painter_);
    rest = rest.subspan(count);
  }
  for (std::size_t k = of_elements; k < corners.size(); ++k) {
    const Inks of_vertex = inks(sees_vertex(corners[k].vertex));
    if (const auto place = view.place(points[k]))
      painter_->dot(*place, 9.0F * style.scale, DotShape::Round, of_vertex.highlight, of_vertex.casing);
  }
  if (has_worst)
    ring(rest.first(table->corners(*wanted.worst).size()), view, style, inks(sees_element(*wanted.worst) && !wanted.worst_behind),
         *painter_);
}

void Scene::gather(const SceneView& view, const Style& style, const Marks& wanted) {
  try {
    gather_of_mesh(view, style, wanted);
  } catch (const DeviceError&) {  // no marks; the next frame finds out what is wrong
  }
  for (const OverlayLine& l : wanted.lines) line(view, l.from, l.to, l.width * style.scale, l.colour, *painter_);
  std::vector<std::pair<double, std::size_t>> order;  // farthest first
  order.reserve(wanted.dots.size());
  for (std::size_t i = 0; i < wanted.dots.size(); ++i) order.emplace_back(-view.depth(wanted.dots[i].point), i);
  std::ranges::sort(order);
  for (const auto& [depth, i] : order) {
    const OverlayDot& dot = wanted.dots[i];
    if (const auto place = view.place(dot.point))
      painter_->dot(*place, dot.diameter * style.scale, dot.shape, dot.colour, style.casing_colour);
  }
}

void Scene::put_marks(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, Vec2<double> viewport,
                      const PicturePart& part) {
  target.bind();
  gather(view_of(camera, viewport, part), style, marks);
  const auto* orbit = std::get_if<OrbitCamera>(&camera);
  if (orbit != nullptr && marks.triad) gather_triad(*orbit, viewport, part, style, *painter_);
  View flat;
  const Vec2<double> size = part.high - part.low;
  flat.viewport = {static_cast<float>(size.x), static_cast<float>(size.y)};
  begin_marks();
  painter_->flush(flat, style.scale);
}

}  // namespace dmoscope::render
