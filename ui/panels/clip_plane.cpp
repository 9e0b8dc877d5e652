// The clip plane over a volume mesh: its outline, and a handle in its middle that moves it along its normal.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "ui/commands/clipping_commands.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

/// The handle on the screen.
struct Handle {
  ImVec2 middle;
  ImVec2 arrow;        // tip of the arrow, on the side that is taken away
  Vec2<double> along;  // way on the screen for a step of 1 of the plane's offset, in pixels; y downwards
};

struct PlaneDrawing {
  render::Projection projection;
  Vec2<double> viewport;
  ImVec2 origin;
  [[nodiscard]] std::optional<ImVec2> place(Vec3 point) const {
    const auto at = projection.place(point);
    if (!at) return std::nullopt;
    return ImVec2{origin.x + static_cast<float>(0.5 * viewport.x + at->x), origin.y + static_cast<float>(0.5 * viewport.y - at->y)};
  }
};

PlaneDrawing drawing_of(const PanelContext& context, const PaneFacts& pane) {
  const ViewState& state = context.state;
  return {state.orbit.projection(state.viewport, pane.box), state.viewport, {pane.rect.x, pane.rect.y}};
}

/// Whether a pane shows the plane; not while all cells give way to an inspected search.
bool has_plane(const PanelContext& context, const PaneFacts& pane) {
  const InspectionState& inspection = context.state.inspection;
  if (pane.inspected && inspection.open && inspection.alone && !inspection.applied) return false;
  return pane.frame() != nullptr && pane.cells_seen && context.state.inside.clip.on && !pane.box.empty();
}

std::array<Vec3, 8> corners_of(const render::Bounds3& box) {
  std::array<Vec3, 8> corners;
  for (unsigned k = 0; k < 8; ++k)
    corners[k] = {(k & 1U) != 0 ? box.high.x : box.low.x, (k & 2U) != 0 ? box.high.y : box.low.y, (k & 4U) != 0 ? box.high.z : box.low.z};
  return corners;
}

/// Polygon in which the plane cuts the box, around its middle. Empty if it misses the box.
std::vector<Vec3> section(const ClipPlane& plane, const render::Bounds3& box) {
  const std::array<Vec3, 8> corners = corners_of(box);
  std::vector<Vec3> points;
  for (unsigned k = 0; k < 8; ++k) {
    for (const unsigned bit : {1U, 2U, 4U}) {
      if ((k & bit) != 0) continue;
      const double a = dot(plane.normal, corners[k]) - plane.offset, b = dot(plane.normal, corners[k | bit]) - plane.offset;
      if ((a < 0.0) == (b < 0.0)) continue;
      points.push_back(corners[k] + a / (a - b) * (corners[k | bit] - corners[k]));
    }
  }
  if (points.size() < 3) return {};
  Vec3 middle{};
  for (const Vec3& p : points) middle = middle + 1.0 / static_cast<double>(points.size()) * p;
  const Vec3 n = 1.0 / length(plane.normal) * plane.normal;
  const Vec3 u = points.front() - middle, v = cross(n, u);
  const auto angle = [&](const Vec3& p) { return std::atan2(dot(p - middle, v), dot(p - middle, u)); };
  std::ranges::sort(points, {}, angle);
  return points;
}

/// The middle of the box, moved onto the plane along its normal.
Vec3 middle_of(const ClipPlane& plane, const render::Bounds3& box) {
  const Vec3 centre = box.centre();
  const double squared = dot(plane.normal, plane.normal);
  return centre + (plane.offset - dot(plane.normal, centre)) / squared * plane.normal;
}

std::optional<Handle> handle_of(const PanelContext& context, const PaneFacts& pane) {
  const ClipPlane& plane = context.state.inside.clip;
  const PlaneDrawing drawing = drawing_of(context, pane);
  const Vec3 middle = middle_of(plane, pane.box);
  const double size = length(plane.normal), step = 0.01 * std::max(pane.box.radius(), 1e-150);
  const Vec3 unit = 1.0 / size * plane.normal;
  const auto at = drawing.place(middle), beside = drawing.place(middle + step * unit);
  if (!at || !beside) return std::nullopt;
  Handle handle;
  handle.middle = *at;
  const double x = static_cast<double>(beside->x - at->x) / step, y = static_cast<double>(beside->y - at->y) / step;  // per unit of length
  handle.along = {x / size, y / size};
  // Seen from straight above, the arrow has no direction: it then points up and is dragged upwards.
  const double seen = std::hypot(x, y) * context.state.orbit.units_per_pixel(context.state.viewport);  // 1: seen from the side
  const double side = plane.flip ? -1.0 : 1.0;
  constexpr double kLeastSeen = 0.15;
  if (seen < kLeastSeen) {
    const double towards = dot(unit, context.state.orbit.back()) >= 0.0 ? 1.0 : -1.0;
    const double each = 1.0 / context.state.orbit.units_per_pixel(context.state.viewport) / size;
    handle.along = {0.0, -towards * each};
  }
  const double each_step = std::hypot(handle.along.x, handle.along.y);
  const double reach = static_cast<double>(context.px(46)) * std::max(seen, 0.45);
  handle.arrow = {handle.middle.x + static_cast<float>(side * reach * handle.along.x / each_step),
                  handle.middle.y + static_cast<float>(side * reach * handle.along.y / each_step)};
  return handle;
}

void drag(PanelContext& context, const PaneFacts& pane, const Handle& handle) {
  InsideGrip& grip = context.widgets.inside_grip;
  ClippingView& view = context.state.inside;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Vec2<double> at{static_cast<double>(mouse.x), static_cast<double>(mouse.y)};
  if (ImGui::IsItemActivated()) grip = {true, view, at};
  if (!grip.held) return;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, context.px(2))) {
    const Vec2<double> way{at.x - grip.pressed_at.x, at.y - grip.pressed_at.y};
    const double squared = handle.along.x * handle.along.x + handle.along.y * handle.along.y;
    const auto [low, high] = span_of(view.clip, pane.box);
    const double moved = (way.x * handle.along.x + way.y * handle.along.y) / squared;
    view.clip.offset = std::clamp(grip.before.clip.offset + moved, low, high);
    context.widgets.moved_at = context.now;
  }
  if (!ImGui::IsItemDeactivated()) return;  // held by another part of the panel, perhaps
  grip.held = false;
  if (view == grip.before) return;
  const std::string command = clip_command(view.clip, pane.box);
  view = grip.before;  // only the command moves it
  context.send(command);
}

}  // namespace

void handle_clip_plane(PanelContext& context, const PaneFacts& pane) {
  if (!has_plane(context, pane)) return;
  const auto handle = handle_of(context, pane);
  if (!handle) return;
  // The arrow and the disc at its foot.
  const float reach = context.px(11);
  const ImVec2 low{std::min(handle->middle.x, handle->arrow.x) - reach, std::min(handle->middle.y, handle->arrow.y) - reach};
  const ImVec2 high{std::max(handle->middle.x, handle->arrow.x) + reach, std::max(handle->middle.y, handle->arrow.y) + reach};
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("clip handle", {high.x - low.x, high.y - low.y});
  if (pane.focus) context.items.record("clip-handle", {low.x, low.y, high.x, high.y});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  if (!ImGui::IsItemActive()) next_item_tooltip("drag to move the clip plane · double click: the other side");
  const bool doubled = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  drag(context, pane, *handle);
  if (doubled) context.send("clip flip");
}

void draw_clip_plane(const PanelContext& context, const PaneFacts& pane) {
  if (!has_plane(context, pane)) return;
  const PlaneDrawing drawing = drawing_of(context, pane);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = colour(context.palette.accent), casing = colour(context.palette.background, 0.7F);
  std::vector<ImVec2> outline;
  for (const Vec3& point : section(context.state.inside.clip, pane.box)) {
    const auto at = drawing.place(point);
    if (!at) return;
    outline.push_back(*at);
  }
  if (outline.size() >= 3) {
    const auto n = static_cast<int>(outline.size());
    list.AddPolyline(outline.data(), n, casing, ImDrawFlags_Closed, context.px(3.0F));
    list.AddPolyline(outline.data(), n, ink, ImDrawFlags_Closed, context.px(1.25F));
  }
  const auto handle = handle_of(context, pane);
  if (!handle) return;
  const ImVec2 from = handle->middle, to = handle->arrow;
  const float dx = to.x - from.x, dy = to.y - from.y, size = std::max(std::hypot(dx, dy), 1.0F), ux = dx / size, uy = dy / size;
  const float head = context.px(12), half = context.px(7);
  const ImVec2 neck{to.x - ux * head, to.y - uy * head};
  for (const auto& [tint, more] : {std::pair{casing, context.px(1.5F)}, {ink, 0.0F}}) {
    list.AddLine(from, neck, tint, context.px(3) + 2 * more);
    list.AddTriangleFilled({to.x + ux * 2 * more, to.y + uy * 2 * more},
                           {neck.x - ux * more - uy * (half + more), neck.y - uy * more + ux * (half + more)},
                           {neck.x - ux * more + uy * (half + more), neck.y - uy * more - ux * (half + more)}, tint);
    list.AddCircleFilled(from, context.px(7) + more, tint);
  }
}

}  // namespace dmoscope::ui
