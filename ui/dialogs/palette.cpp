// The palette (Ctrl+P): every action, every command, and any line of the command language.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels/panels.h"
#include "ui/state/actions.h"

namespace dmoscope::ui {
namespace {

int move_selection(int selected, int size) {
  if (ImGui::IsKeyPressed(key::kDown)) ++selected;
  if (ImGui::IsKeyPressed(key::kUp)) --selected;
  return std::clamp(selected, 0, std::max(0, size - 1));
}

/// Place of an entry's detail relative to its upper left corner: at the right of the title, else below it. Nothing is cut.
struct EntryLayout {
  ImVec2 detail;
  float wrap = 0, height = 0;
};
EntryLayout lay_out_entry(const PanelContext& context, const PaletteEntry& entry, float width) {
  const float line = ImGui::GetTextLineHeight(), edge = context.px(8), indent = 1.2F * context.em();
  const float title = ImGui::CalcTextSize(entry.title.c_str()).x, detail = ImGui::CalcTextSize(entry.detail.c_str()).x;
  if (title + 2 * context.em() + detail + edge <= width) return {{width - detail - edge, 0}, 0, line};
  EntryLayout layout;
  layout.wrap = width - edge - indent;
  const float below = ImGui::CalcTextSize(entry.title.c_str(), nullptr, false, layout.wrap).y;
  layout.detail = {indent, below};
  layout.height = below;
  if (!entry.detail.empty()) layout.height += ImGui::CalcTextSize(entry.detail.c_str(), nullptr, false, layout.wrap).y;
  return layout;
}

}  // namespace

void draw_palette_dialog(PanelContext& context) {
  if (!begin_dialog(context, "All commands", 44, 32)) return;
  WidgetState& widgets = context.widgets;
  if (widgets.dialog_opened) {
    widgets.palette.text.clear();
    widgets.palette.selected = 0;
  }
  if (widgets.dialog_opened || ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const std::string before = widgets.palette.text;
  const bool entered = ImGui::InputTextWithHint("##command", "search, or type a command such as: step class 3", &widgets.palette.text,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("palette:text");
  if (before != widgets.palette.text) widgets.palette.selected = 0;
  const std::vector<PaletteEntry> entries = palette_entries(widgets.palette.text, context.situation(), context.commands);
  const int moved = move_selection(widgets.palette.selected, static_cast<int>(entries.size()));
  const bool scroll = moved != widgets.palette.selected;
  widgets.palette.selected = moved;

  int chosen = entered && !entries.empty() ? widgets.palette.selected : -1;
  ImGui::BeginChild("list");
  for (int k = 0; k < static_cast<int>(entries.size()); ++k) {
    const PaletteEntry& entry = entries[static_cast<std::size_t>(k)];
    ImGui::PushID(k);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImGuiSelectableFlags flags = entry.possible ? ImGuiSelectableFlags_DontClosePopups : ImGuiSelectableFlags_Disabled;
    const EntryLayout layout = lay_out_entry(context, entry, width);
    if (ImGui::Selectable("##entry", k == widgets.palette.selected, flags, {0, layout.height})) chosen = k;
    context.items.record_last(fmt::format("palette:{}", k));
    if (scroll && k == widgets.palette.selected) ImGui::SetScrollHereY();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float alpha = entry.possible ? 1.0F : 0.45F;
    const auto put = [&](ImVec2 where, render::Rgb ink, const std::string& text) {
      list.AddText(context.fonts.body, context.em(), where, colour(ink, alpha), text.c_str(), nullptr, layout.wrap);
    };
    put(at, context.palette.text, entry.title);
    put({at.x + layout.detail.x, at.y + layout.detail.y}, context.palette.dim, entry.detail);
    ImGui::PopID();
  }
  if (entries.empty()) dim_text(context, "no action has this name; Enter runs it as a command");
  ImGui::EndChild();
  end_dialog();

  if (chosen >= 0 && entries[static_cast<std::size_t>(chosen)].possible) {
    const PaletteEntry& entry = entries[static_cast<std::size_t>(chosen)];
    if (!entry.complete) {
      widgets.palette.text = entry.command;
      return;
    }
    context.state.dialog = Dialog::None;
    context.send(entry.command);
  } else if (entered && entries.empty() && !widgets.palette.text.empty()) {
    context.state.dialog = Dialog::None;
    context.send(widgets.palette.text);
  }
}

}  // namespace dmoscope::ui
