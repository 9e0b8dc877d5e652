// The brush that selects vertices.
#include <cmath>

#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

StrokeKind kind_of(const ImGuiIO& io) { return io.KeyCtrl ? StrokeKind::Remove : io.KeyShift ? StrokeKind::Add : StrokeKind::Select; }

/// Selects everything under the way from the brush's last place to `at`.
void paint_to(PanelContext& context, Vec2<double> at, double radius) {
  Brush& brush = context.state.brush;
  const Vec2<double> way = at - brush.last;
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * std::hypot(way.x, way.y) / radius)));
  std::vector<Index> touched;
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const auto near = context.vertices_near(context.widgets.brush_pane, {brush.last.x + t * way.x, brush.last.y + t * way.y}, radius);
    touched.insert(touched.end(), near.begin(), near.end());
  }
  if (!touched.empty()) brush.stroke.add(touched);
  brush.last = at;
}

void end_stroke(PanelContext& context) {
  Brush& brush = context.state.brush;
  brush.painting = false;
  const std::string ids = id_ranges(brush.stroke.vertices());
  if (ids.empty()) {
    if (brush.kind == StrokeKind::Select && !context.state.selection.empty()) context.send("select none");
    return;
  }
  constexpr const char* kCommands[] = {"select vertex ", "select add ", "select remove "};  // in the order of StrokeKind
  context.send(kCommands[static_cast<int>(brush.kind)] + ids);
}

void draw_cursor(const PanelContext& context, Vec2<double> at, const Rect& rect, double radius) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle{rect.x + static_cast<float>(at.x), rect.y + static_cast<float>(at.y)};
  const auto pixels = static_cast<float>(radius);
  list.AddCircle(middle, pixels, colour(context.palette.background), 0, context.px(3.5F));
  list.AddCircle(middle, pixels, colour(context.palette.text), 0, context.px(1.5F));
}

}  // namespace

bool handle_brush(PanelContext& context, const PaneFacts& pane, Vec2<double> at) {
  Brush& brush = context.state.brush;
  const Frame* frame = pane.frame();
  if (brush.painting && context.widgets.brush_pane != pane.number) return true;
  if (!brush.on || frame == nullptr || frame->device) {
    brush.painting = false;
    return false;
  }
  const double radius = brush.radius * context.state.scale;
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    brush.painting = true;
    context.widgets.brush_pane = pane.number;
    brush.kind = kind_of(ImGui::GetIO());
    brush.stroke.clear();
    brush.last = at;
    paint_to(context, at, radius);
  } else if (brush.painting) {
    const bool moved = at.x != brush.last.x || at.y != brush.last.y;
    if (moved) paint_to(context, at, radius);
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) end_stroke(context);
  }
  if (ImGui::IsItemHovered() || brush.painting) draw_cursor(context, at, pane.rect, radius);
  return true;
}

}  // namespace dmoscope::ui
