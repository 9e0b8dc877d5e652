// Edges of the panels: dragging resizes panels, and chevrons fold and unfold them.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

/// Begins a window of its own above the panels whose edge it lies on, without any look.
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

/// Draws a tab over the mesh, in the middle of an edge that can be folded; true when it is clicked.
bool fold_tab(PanelContext& context, const char* name, Icon icon, const char* tooltip, const Rect& rect) {
  begin_edge(fmt::format("{} tab", name).c_str(), rect);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.panel, 0.9F), context.px(4));
  list.AddRect({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.line), context.px(4));
  const bool clicked = icon_button(context, fmt::format("fold:{}", name), icon, {rect.w, rect.h}, tooltip);
  ImGui::End();
  return clicked;
}

/// Draws the tab that folds all docks of a side, or opens them.
void draw_column_tab(PanelContext& context, Side side, const Rect& rect) {
  const Panels& panels = context.state.panels;
  const bool open = panels.has_column(side), points_left = open == (side == Side::Left);
  const bool both = panels.setup_side == panels.facts_side;
  const std::string keys = both ? "F2, F3" : panels.setup_side == side ? "F2" : "F3";
  if (!fold_tab(context, side == Side::Left ? "left" : "right", points_left ? Icon::ChevronLeft : Icon::ChevronRight,
                fmt::format("{} ({})", open ? "folds this column" : "opens the column", keys).c_str(), rect))
    return;
  const char* word = open ? "off" : "on";
  if (panels.setup_side == side) context.send(fmt::format("panel setup {}", word));
  if (panels.facts_side == side) context.send(fmt::format("panel facts {}", word));
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
  if (!layout.bottom.empty())
    splitter(context,
             {"bottom", {layout.bottom.x, layout.bottom.y - grip / 2, layout.bottom.w, grip}, false, -1, &Panels::bottom_height, 9, 40});

  const Panels& panels = context.state.panels;
  const float along = context.px(44), across = context.px(13);
  const Rect& mesh = layout.viewport;
  if (mesh.w < 2 * along || mesh.h < 2 * along) return;
  const float middle = std::round(mesh.y + mesh.h / 2 - along / 2);
  if (!layout.folded) {
    if (panels.uses(Side::Left)) draw_column_tab(context, Side::Left, {mesh.x, middle, across, along});
    if (panels.uses(Side::Right)) draw_column_tab(context, Side::Right, {mesh.x + mesh.w - across, middle, across, along});
  }
  const float share = mesh.w < context.em() * 62 ? 0.66F : 0.5F;  // in a narrow one the colour bar reaches the middle
  const bool has_plots = !layout.bottom.empty();
  if (layout.timeline.empty() || panels.plots() != has_plots) return;  // no mesh, or no room for plots
  if (fold_tab(context, "bottom", has_plots ? Icon::ChevronDown : Icon::ChevronUp,
               has_plots ? "folds the plots (F4)" : "opens the plots (F4)",
               {std::round(mesh.x + mesh.w * share - along / 2), mesh.y + mesh.h - across, along, across}))
    context.send("panel bottom toggle");
}

}  // namespace dmoscope::ui
