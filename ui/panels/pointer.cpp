// The pointer over a mesh: it shows the value of the element where it rests, clicks on axes, and paints with the brush; and ids on the
// mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "render/triad.h"
#include "ui/analysis/scene_points.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr double kRest = 0.35;                  // seconds until a pointer rests
constexpr std::size_t kMostElements = 300'000;  // with more, finding the one under the pointer takes longer than a person waits

bool presses(const ImGuiIO& io) { return io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2]; }

void show_value(PanelContext& context, const Frame& frame, Index element) {
  if (element >= frame.quality.size()) return;
  const float quality = frame.quality[element];
  const std::string value = std::isnan(quality) ? std::string("not defined") : short_number(static_cast<double>(quality));
  ImGui::BeginTooltip();
  ImGui::PushFont(context.fonts.bold);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  const auto angles = frame.inverted[element] == 0 ? angles_of(frame, element) : std::nullopt;
  const std::string least = angles ? degrees(angles->smallest) + " · " : std::string();
  dim_text(context, fmt::format("{} · {}element {}", metric_phrase(frame.shown), least, element), false);
  ImGui::EndTooltip();
}

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

void handle_rest(PanelContext& context, const PaneFacts& pane, Vec2<double> at) {
  PointerRest& rest = context.widgets.pointer_rest;
  const ImGuiIO& io = ImGui::GetIO();
  const Frame& frame = *pane.frame();
  const bool same = rest.pane == pane.number && rest.at.x == at.x && rest.at.y == at.y && rest.picture == pane.picture_serial;
  if (!same || presses(io) || io.MouseWheel != 0) rest = {pane.number, at, pane.picture_serial, context.now};
  rest.over = true;
  if (!context.state.pointer_value || presses(io) || frame.device || frame.element_count() > kMostElements) return;
  const double waits = rest.since + kRest - context.now;
  if (waits > 0.0) {
    rest.wakes_in = waits;
    return;
  }
  if (!rest.element) rest.element = context.pick(pane.number, at).second;
  if (*rest.element != kNoIndex) show_value(context, frame, *rest.element);
}

void handle_axes(PanelContext& context, const PaneFacts& pane) {
  if (pane.frame() == nullptr || !pane.frame()->input->in_space()) return;
  const render::OrbitCamera& camera = context.state.orbit;
  const auto letters =
      render::triad_letters(camera, {static_cast<double>(pane.rect.w), static_cast<double>(pane.rect.h)}, context.state.scale);
  constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const float reach = context.px(11);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    constexpr double kAlong = 0.999;
    const char letter = static_cast<char>('x' + i);
    const bool from_behind = dot(kAxes[i], camera.back()) > kAlong;  // the camera looks along the axis already
    ImGui::SetCursorScreenPos(
        {pane.rect.x + static_cast<float>(letters[i].x) - reach, pane.rect.y + static_cast<float>(letters[i].y) - reach});
    const std::string item = fmt::format("axis:{}", letter);
    if (ImGui::InvisibleButton(item.c_str(), {2 * reach, 2 * reach}))
      context.send(fmt::format("view-from {}{}", from_behind ? '-' : '+', letter));
    note_item(context, item, fmt::format("look along {}{}", letter, from_behind ? ", from behind" : "; once more: from behind"));
  }
}

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

void draw_pick_label(PanelContext& context, const PaneFacts& pane) {
  const Picked picked = context.derived.facts.picked;
  const Frame& frame = *pane.frame();
  const bool here = pane.focus && pane.view && pane.session->input == context.session.input && !frame.positions.empty();
  if (!here || picked.kind != Picked::Kind::Element || picked.id >= frame.quality.size() || context.state.inspection.open) return;
  const ScenePoints points = ScenePoints::of(*frame.input);
  const auto corners = frame.input->mesh.elements.corners(picked.id);
  render::Bounds2 box;  // pixels from the middle, y up
  for (const Index v : corners) {
    const auto place = pane.view->place(points.at(frame.positions[v], frame.positions[corners[0]]));
    if (!place) return;
    box.include(*place);
  }
  const auto size = static_cast<float>(std::hypot(box.size().x, box.size().y));
  const Rect& clip = pane.clip;
  const ImVec2 at{pane.rect.x + pane.rect.w / 2 + static_cast<float>(box.centre().x),
                  pane.rect.y + pane.rect.h / 2 - static_cast<float>(box.centre().y)};
  const bool seen = at.x > clip.x && at.x < clip.x + clip.w && at.y > clip.y && at.y < clip.y + clip.h;
  if (!seen || size > 0.6F * clip.h) return;  // it needs no line
  const std::string text = fmt::format("Element {}  {}", picked.id, short_number(static_cast<double>(frame.quality[picked.id])));
  const ImVec2 words = ImGui::CalcTextSize(text.c_str());
  const float pad = context.px(6), width = words.x + 2 * pad, height = words.y + pad, out = context.px(28);
  const float away = 0.71F * std::max(context.px(15), 0.58F * size + context.px(6));  // outside the ring of the worst element
  const Rect& free = pane.uncovered;
  const float right = at.x + away + out + width < free.x + free.w || at.x - away - out - width < free.x ? 1.0F : -1.0F;
  const float down = at.y - away - out - height < clip.y + 3 * height ? 1.0F : -1.0F;
  const ImVec2 from{at.x + right * away, at.y + down * away}, to{from.x + right * out, from.y + down * out};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine(from, to, colour(context.palette.background), context.px(3.5F));
  list.AddLine(from, to, colour(context.palette.text), context.px(1.5F));
  const Rect plate =
      draw_plate(context, {right > 0 ? to.x : to.x - width, down > 0 ? to.y : to.y - height}, text, context.palette.text, pad);
  context.items.record("pick-label", {plate.x, plate.y, plate.x + plate.w, plate.y + plate.h});
}

void draw_labels(PanelContext& context, const PaneFacts& pane) {
  const Rect& rect = pane.rect;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float size = std::round(0.8F * context.em());
  for (const render::Label& label : pane.labels) {
    const std::string text = std::to_string(label.id);
    const ImVec2 extent = context.fonts.body->CalcTextSizeA(size, FLT_MAX, 0.0F, text.c_str());
    const Vec2<double> at{0.5 * context.state.viewport.x + label.point.x, 0.5 * context.state.viewport.y - label.point.y};
    const ImVec2 low{std::round(rect.x + static_cast<float>(at.x) - extent.x / 2),
                     std::round(rect.y + static_cast<float>(at.y) - extent.y / 2)};
    const float pad = context.px(2);
    // Labels of vertices are dark on light, those of elements light on dark.
    const render::Rgb plate = label.vertex ? context.palette.text : context.palette.panel;
    const render::Rgb ink = label.vertex ? context.palette.panel : context.palette.text;
    list.AddRectFilled({low.x - pad, low.y}, {low.x + extent.x + pad, low.y + extent.y}, colour(plate, 0.88F), context.px(3));
    list.AddText(context.fonts.body, size, low, colour(ink), text.c_str());
  }
}

}  // namespace dmoscope::ui
