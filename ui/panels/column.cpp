// A column beside the mesh: the dock of setup, below it that of facts with its tabs.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

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
