#include <cmath>

#include "render/colour_map.h"
#include "render/draw_order.h"
#include "ui/toolkit/screen_occupancy.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {

std::vector<Index> inverted_elements(const Frame& frame) {
  std::vector<Index> found;
  for (Index e = 0; e < frame.inverted.size(); ++e)
    if (frame.inverted[e] != 0) found.push_back(e);
  const std::size_t stride = (found.size() + kMostMarks - 1) / kMostMarks;
  for (std::size_t k = 1; stride > 1 && k * stride < found.size(); ++k) found[k] = found[k * stride];
  if (stride > 1) found.resize((found.size() + stride - 1) / stride);
  return found;
}

void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements) {
  constexpr double kSmall = 8.0, kApart = 16.0;  // pixels at scale 1
  const render::Bounds2 window = view.window();
  const Plane& plane = frame.input->geometry.plane;
  CellsTaken taken(window, view.units(kApart));
  const render::Rgb magenta = render::kInvertedColour;
  for (const Index e : elements) {
    render::Bounds2 box;
    const auto corners = frame.input->mesh.elements.corners(e);
    for (const Index v : corners) box.include(render::place_near(plane, frame.positions[v], frame.positions[corners[0]]));
    const Vec2<double> size = box.size(), middle{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y)};
    if (std::hypot(size.x, size.y) > view.units(kSmall)) continue;
    if (middle.x < window.low.x || middle.x > window.high.x || middle.y < window.low.y || middle.y > window.high.y) continue;
    if (taken.take(middle))
      marks.dots.push_back({middle, static_cast<float>(kSmall), {magenta.r, magenta.g, magenta.b, 255}, render::DotShape::Diamond});
  }
}

void add_diamond(render::SpaceMarks& marks, Vec3 at, float diameter, render::Rgba colour, const render::Style& style) {
  marks.dots.push_back({at, diameter + 5.0F, style.casing_colour, render::DotShape::Diamond});
  marks.dots.push_back({at, diameter, colour, render::DotShape::Diamond});
}

void add_inverted_inside(render::SpaceMarks& marks, const Frame& frame, const render::Style& style) {
  for (const RankedElement& ranked : frame.worst)
    if (ranked.inside) add_diamond(marks, *ranked.inside, 8.0F, style.highlight_colour, style);
}

}  // namespace dmoscope::ui
