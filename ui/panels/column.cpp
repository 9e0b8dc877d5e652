// Columns of docks, and edges of the panels: dragging resizes panels, and chevrons fold and unfold them.
#include <algorithm>
#include <array>
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
bool fold_tab(PanelContext& context, const char* name, std::string_view icon, const char* tooltip, const Rect& rect) {
  begin_edge(fmt::format("{} tab", name).c_str(), rect);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.panel, 0.9F), context.px(4));
  list.AddRect({rect.x, rect.y}, {rect.x + rect.w, rect.y + rect.h}, colour(context.palette.line), context.px(4));
  const bool clicked = icon_button(context, fmt::format("fold:{}", name), icon, {rect.w, rect.h}, tooltip);
  ImGui::End();
  return clicked;
}

/// Draws the tab that folds all docks of a side, or opens them. `over`: over the mesh.
void draw_column_tab(PanelContext& context, Side side, const Rect& rect, bool over) {
  const Panels& panels = context.state.panels;
  const bool open = over ? panels.over(side) : panels.has_column(side), points_left = open == (side == Side::Left);
  const bool both = panels.setup_side == panels.facts_side, setup = panels.setup_side == side;
  const std::string what = both ? "setup and facts (F2, F3)" : setup ? "setup (F2)" : "facts (F3)";
  const char *name = side == Side::Left ? "left" : "right", *word = open ? "off" : "on";
  if (!fold_tab(context, name, points_left ? Icon::kChevronLeft : Icon::kChevronRight, ((open ? "folds " : "opens ") + what).c_str(), rect))
    return;
  if (over) return context.send(fmt::format("unfold {} {}", name, word));
  if (setup) context.send(fmt::format("panel setup {}", word));
  if (panels.facts_side == side) context.send(fmt::format("panel facts {}", word));
}

void splitter(PanelContext& context, const SplitterEdge& edge) {
  begin_edge(fmt::format("splitter:{}", edge.panel).c_str(), edge.rect);
  splitter_grip(context, edge);
  ImGui::End();
}

constexpr float kLeastFacts = 14.0F, kFactsBesideSettings = 7.0F, kLeastSetup = 12.0F;  // heights in units of the font's height

struct TabInfo {
  FactsTab tab;
  const char* item;
  const char* title;
  const char* tooltip;
};
constexpr std::array<TabInfo, 5> kTabs{{{FactsTab::Mesh, "tab:mesh", "Mesh", "numbers of the mesh, its quality and its groups"},
                                        {FactsTab::Selection, "tab:selection", "Selection", "the vertex or element that you selected"},
                                        {FactsTab::Worst, "tab:worst", "Worst", "the worst elements by the shown metric"},
                                        {FactsTab::Colours, "tab:colours", "Colours", "what the colours mean, and which elements count"},
                                        {FactsTab::Inside, "tab:inside", "Inside", "clip plane, hidden layers and hidden qualities"}}};

/// Draws the tabs in one row of constant height.
void draw_tabs(PanelContext& context, FactsTab shown) {
  const std::size_t number = context.state.in_space ? kTabs.size() : kTabs.size() - 1;
  const float room = ImGui::GetContentRegionAvail().x, height = std::round(2.1F * context.em());
  float words = 0;
  for (std::size_t k = 0; k < number; ++k) words += ImGui::CalcTextSize(kTabs[k].title).x;
  const float around = std::max(context.px(2), (room - words) / static_cast<float>(number));  // space around each word
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  float x = corner.x;
  for (std::size_t k = 0; k < number; ++k) {
    const TabInfo& one = kTabs[k];
    const ImVec2 text = ImGui::CalcTextSize(one.title);
    const float width = std::floor(text.x + around);
    ImGui::SetCursorScreenPos({x, corner.y});
    if (ImGui::InvisibleButton(one.item, {width, height})) context.send(fmt::format("tab {}", one.item + sizeof("tab")));
    note_item(context, one.item, one.tooltip);
    const bool on = one.tab == shown;
    const render::Rgb ink = on || ImGui::IsItemHovered() ? context.palette.text : context.palette.dim;
    list.AddText({x + (width - text.x) / 2, corner.y + (height - text.y) / 2}, colour(ink), one.title);
    if (on)
      list.AddRectFilled({x + context.px(2), corner.y + height - context.px(2)}, {x + width - context.px(2), corner.y + height},
                         colour(context.palette.accent), context.px(1));
    x += width;
  }
  list.AddLine({corner.x, corner.y + height}, {corner.x + room, corner.y + height}, colour(context.palette.line));
  ImGui::SetCursorScreenPos({corner.x, corner.y + height});
  ImGui::Dummy({room, context.px(2)});
}

void draw_tab(PanelContext& context, FactsTab tab) {
  switch (tab) {
    case FactsTab::Mesh:
      draw_mesh_facts(context);
      draw_groups(context);
      draw_loops(context);
      return;
    case FactsTab::Selection:
      if (context.state.inspection.open) draw_inspection(context);
      draw_selection(context);
      return;
    case FactsTab::Worst:
      draw_worst(context);
      return;
    case FactsTab::Colours:
      draw_colours(context);
      return;
    case FactsTab::Inside:
      draw_clipping(context);
      return;
  }
}

/// Begins a part of the column that scrolls by itself. Its contents have the same width with and without a scroll bar, so that no button
/// moves when the bar comes.
void begin_scrolled(const char* name, float height) {
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(name);
  const float bar = storage.GetBool(id) ? 0.0F : ImGui::GetStyle().ScrollbarSize;
  ImGui::BeginChild(name, {-std::max(bar, FLT_MIN), height});
}
void end_scrolled(const char* name) {
  const bool has_bar = ImGui::GetScrollMaxY() > 0.0F;
  ImGui::EndChild();
  ImGui::GetStateStorage()->SetBool(ImGui::GetID(name), has_bar);
}

void draw_facts(PanelContext& context) {
  FactsTab tab = context.state.panels.tab;
  if (tab == FactsTab::Inside && !context.state.in_space) tab = FactsTab::Mesh;
  draw_tabs(context, tab);
  // Each tab has a scroll position of its own.
  begin_scrolled(kTabs[static_cast<std::size_t>(tab)].item, 0);
  draw_tab(context, tab);
  end_scrolled(kTabs[static_cast<std::size_t>(tab)].item);
}

void draw_setup(PanelContext& context) {
  draw_runs(context);
  draw_parameters(context);
}

/// Draws the setup above the facts, as high as its contents were in the last frame if the facts keep their room.
void draw_setup_above(PanelContext& context) {
  float& wanted = context.widgets.setup_height;
  const float room = ImGui::GetContentRegionAvail().y, em = context.em();
  const float facts = context.state.panels.settings ? kFactsBesideSettings : kLeastFacts;
  const float most = std::max(kLeastSetup * em, room - facts * em);
  begin_scrolled("setup", std::min(wanted > 0 ? wanted : most, most));
  const float top = ImGui::GetCursorPosY();
  draw_setup(context);
  wanted = ImGui::GetCursorPosY() - top;
  end_scrolled("setup");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y}, {at.x + ImGui::GetContentRegionAvail().x, at.y}, colour(context.palette.line));
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
  const Rect free = layout.uncovered();
  if (panels.uses(Side::Left)) draw_column_tab(context, Side::Left, {free.x, middle, across, along}, layout.folded);
  if (panels.uses(Side::Right)) draw_column_tab(context, Side::Right, {free.x + free.w - across, middle, across, along}, layout.folded);
  const float share = mesh.w < context.em() * 62 ? 0.66F : 0.5F;  // in a narrow one the colour bar reaches the middle
  const bool has_plots = !layout.bottom.empty();
  if (layout.timeline.empty() || panels.plots() != has_plots) return;  // no mesh, or no room for plots
  if (fold_tab(context, "bottom", has_plots ? Icon::kChevronDown : Icon::kChevronUp,
               has_plots ? "folds the plots (F4)" : "opens the plots (F4)",
               {std::round(mesh.x + mesh.w * share - along / 2), mesh.y + mesh.h - across, along, across}))
    context.send("panel bottom toggle");
}

void draw_column(PanelContext& context, Side side, const Rect& rect, bool overlay) {
  if (rect.empty()) return;
  // A column over the mesh comes to the front when it opens, and stays there, because the panels below never come to the front. Focusing it
  // in every frame would take clicks and dialogs away from everything else.
  if (overlay) ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(8)});
  begin_panel(fmt::format("{}{}", side == Side::Left ? "left" : "right", overlay ? " over" : "").c_str(), rect, overlay, true);
  ImGui::PopStyleVar(overlay ? 2 : 1);
  const Panels& panels = context.state.panels;
  const bool unfolded = side == Side::Left ? panels.left_over : panels.right_over;  // false: only the facts of the pick are shown
  const bool setup = overlay ? panels.setup_side == side && unfolded : panels.has_setup(side);
  const bool facts = overlay ? panels.facts_side == side : panels.has_facts(side);
  if (setup && facts)
    draw_setup_above(context);
  else if (setup)
    draw_setup(context);
  if (facts) draw_facts(context);
  end_panel();
}

}  // namespace dmoscope::ui
