// The edges of the panels: dragged they resize, by their chevrons panels are folded and come back.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

/// A window of its own above the panels whose edge it lies on, without any look.
void begin_edge(const char* name, const Rect& rect) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4{0, 0, 0, 0});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

/// One of the panels that can be folded.
struct FoldingPanel {
  const char* name;  // "left"
  const char* action;
  Icon to_fold, to_open;
};
constexpr std::array<FoldingPanel, 3> kFolding{{{"left", "panel-left", Icon::ChevronLeft, Icon::ChevronRight},
                                                {"right", "panel-right", Icon::ChevronRight, Icon::ChevronLeft},
                                                {"bottom", "panel-bottom", Icon::ChevronDown, Icon::ChevronUp}}};

/// A tab over the mesh, in the middle of the panel's edge.
void fold_tab(PanelContext& context, const FoldingPanel& panel, bool open, const Rect& rect) {
  begin_edge(fmt::format("{} tab", panel.name).c_str(), rect);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.panel, 0.9F), context.px(4));
  list.AddRect({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.line), context.px(4));
  const Action& action = *find_action(panel.action);
  const std::string tip = fmt::format("{} ({})", open ? "folds this panel" : "opens the panel", action.key);
  if (icon_button(context, fmt::format("fold:{}", panel.name), open ? panel.to_fold : panel.to_open, {rect.w, rect.h}, tip))
    context.send(std::string(action.command));
  ImGui::End();
}

void splitter(PanelContext& context, const SplitterEdge& edge) {
  begin_edge(fmt::format("splitter:{}", edge.panel).c_str(), edge.rect);
  splitter_grip(context, edge);
  ImGui::End();
}

}  // namespace

void splitter_grip(PanelContext& context, const SplitterEdge& edge) {
  const Rect& rect = edge.rect;
  const std::string name = fmt::format("splitter:{}", edge.panel);
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::InvisibleButton(name.c_str(), {rect.w, rect.h});
  context.items.record_last(name);
  const bool live = ImGui::IsItemActive() || ImGui::IsItemHovered();
  if (live) ImGui::SetMouseCursor(edge.upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) next_item_tooltip("drag to resize; double click: the usual size");
  SplitterGrip& grip = context.widgets.splitter_grip;
  double& size = context.state.panels.*edge.size;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double at = static_cast<double>(edge.upright ? mouse.x : mouse.y);
  if (ImGui::IsItemActivated()) grip = {size, at, false};
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    context.send(fmt::format("panel-size {} default", edge.panel));
    grip = {size, at, false};
  } else if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0F)) {
    grip.moved = true;
    size = std::clamp(grip.before + edge.direction * (at - grip.pressed_at) / static_cast<double>(context.em()), edge.least, edge.most);
  } else if (ImGui::IsItemDeactivated() && std::exchange(grip.moved, false)) {
    context.send(fmt::format("panel-size {} {:.2f}", edge.panel, size));
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = std::round(rect.x + rect.w / 2), y = std::round(rect.y + rect.h / 2);
  const ImU32 ink = live ? colour(context.palette.accent) : colour(context.palette.line);
  const float width = live ? context.px(3) : 1.0F;
  if (edge.upright) {
    list.AddLine({x, rect.y}, {x, rect.y + rect.h}, ink, width);
  } else {
    list.AddLine({rect.x, y}, {rect.x + rect.w, y}, ink, width);
  }
}

void draw_splitters(PanelContext& context, const Layout& layout) {
  const float grip = context.px(6);
  if (!layout.folded && !layout.left.empty())
    splitter(
        context,
        {"left", {layout.left.x + layout.left.w - grip / 2, layout.left.y, grip, layout.left.h}, true, 1, &Panels::left_width, 12, 40});
  if (!layout.folded && !layout.right.empty())
    splitter(context, {"right", {layout.right.x - grip / 2, layout.right.y, grip, layout.right.h}, true, -1, &Panels::right_width, 13, 40});
  if (!layout.bottom.empty() && !layout.timeline_only)
    splitter(context,
             {"bottom", {layout.bottom.x, layout.bottom.y - grip / 2, layout.bottom.w, grip}, false, -1, &Panels::bottom_height, 9, 40});

  const Panels& panels = context.state.panels;
  const float along = context.px(44), across = context.px(13);
  const Rect& mesh = layout.viewport;
  if (mesh.w < 2 * along || mesh.h < 2 * along) return;
  const float middle = std::round(mesh.y + mesh.h / 2 - along / 2);
  if (!layout.folded) {
    fold_tab(context, kFolding[0], panels.left, {mesh.x, middle, across, along});
    fold_tab(context, kFolding[1], panels.right, {mesh.x + mesh.w - across, middle, across, along});
  }
  const float share = mesh.w < context.em() * 62 ? 0.66F : 0.5F;  // in a narrow one the colour bar reaches the middle
  const bool has_plots = !layout.bottom.empty() && !layout.timeline_only;
  if (!layout.bottom.empty() && panels.plots() == has_plots)  // else there is no room for them
    fold_tab(context, kFolding[2], has_plots, {std::round(mesh.x + mesh.w * share - along / 2), mesh.y + mesh.h - across, along, across});
}

}  // namespace dmoscope::ui
