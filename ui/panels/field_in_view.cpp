// Over the mesh: the quality around the inspected vertex.
#include "ui/analysis/derived.h"
#include "ui/overlays/inspection_marks.h"
#include "ui/panels/field.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

ImU32 ink_of(render::Rgba c) { return IM_COL32(c.r, c.g, c.b, c.a); }

/// Draws lines and dots in the style of the mesh's own drawing.
class MarkPen {
 public:
  MarkPen(ImDrawList& list, float scale, render::Rgba casing) : list_(list), scale_(scale), casing_(ink_of(casing)) {}

  void line(ImVec2 from, ImVec2 to, const render::OverlayLine& line) { list_.AddLine(from, to, ink_of(line.colour), line.width * scale_); }
  void dot(ImVec2 at, const render::OverlayDot& dot) {
    const float radius = dot.diameter * scale_ / 2, rim = 1.2F * scale_;
    const ImU32 ink = ink_of(dot.colour);
    switch (dot.shape) {
      case render::DotShape::Round:
        list_.AddCircleFilled(at, radius + rim, casing_);
        list_.AddCircleFilled(at, radius, ink);
        break;
      case render::DotShape::Square:
        list_.AddRectFilled({at.x - radius - rim, at.y - radius - rim}, {at.x + radius + rim, at.y + radius + rim}, casing_);
        list_.AddRectFilled({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, ink);
        break;
      case render::DotShape::Ring:
        list_.AddCircle(at, radius, casing_, 0, 2.2F * scale_ + 2 * rim);
        list_.AddCircle(at, radius, ink, 0, 2.2F * scale_);
        break;
      case render::DotShape::Cross:
        cross(at, radius + rim, casing_, 2.2F * scale_ + 2 * rim);
        cross(at, radius, ink, 2.2F * scale_);
        break;
      case render::DotShape::Diamond:
        diamond(at, radius + 1.4F * rim, casing_);
        diamond(at, radius, ink);
        break;
    }
  }

 private:
  void cross(ImVec2 at, float reach, ImU32 ink, float width) {
    list_.AddLine({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach}, ink, width);
    list_.AddLine({at.x - reach, at.y + reach}, {at.x + reach, at.y - reach}, ink, width);
  }
  void diamond(ImVec2 at, float reach, ImU32 ink) {
    list_.AddQuadFilled({at.x - reach, at.y}, {at.x, at.y - reach}, {at.x + reach, at.y}, {at.x, at.y + reach}, ink);
  }

  ImDrawList& list_;
  float scale_;
  ImU32 casing_;
};

}  // namespace

void draw_field_in_view(PanelContext& context, const PaneFacts& pane) {
  const Rect& rect = pane.rect;
  const ViewState& state = context.state;
  const Inspection& inspection = context.inspection;
  if (!pane.inspected || !state.inspection.open || !state.inspection.field_in_view || !inspection.trace || !inspection.field) return;
  const auto window = [&](Vec2<double> point) {
    const Vec2<double> pixel = pane.camera.to_pixel(point, state.viewport);
    return ImVec2{rect.x + static_cast<float>(pixel.x), rect.y + static_cast<float>(pixel.y)};
  };
  const ToWindow at = [&](Vec2<double> point) { return window({inspection.origin.x + point.x, inspection.origin.y + point.y}); };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_field(list, *inspection.field, {colour_scale(state, context.derived), context.palette, context.em(), context.px(1), true}, at);
  const render::Style style = scene_style(state);
  render::Marks marks;
  add_inspection_marks(marks, state.inspection, inspection, inspection_look(state, context.derived, pane.camera.units_per_pixel));
  MarkPen pen(list, context.px(1), style.casing_colour);
  const auto place = [&](Vec3 point) { return window({point.x, point.y}); };
  for (const render::OverlayLine& line : marks.lines) pen.line(place(line.from), place(line.to), line);
  const Vec2<double> stands = state.inspection.applied ? inspection.trace->step : Vec2<double>{};
  pen.dot(at(stands), {{}, 9.0F, style.highlight_colour, render::DotShape::Round});
  for (const render::OverlayDot& dot : marks.dots) pen.dot(place(dot.point), dot);
}

}  // namespace dmoscope::ui
