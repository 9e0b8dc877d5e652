// Menu bar and tool bar, both from the table of actions.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/mesh/generate.h"
#include "ui/commands/view_options.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

void draw_recent(PanelContext& context) {
  if (!ImGui::BeginMenu("Recent", !context.state.recent_files.empty())) return;
  for (const RecentFile& file : context.widgets.recent.list(context.state.recent_files, context.now)) {
    if (ImGui::MenuItem(context.shown(file.path).c_str(), nullptr, false, !file.missing)) context.send(open_command(file.path));
    next_item_tooltip(context.shown(file.reason()));
  }
  ImGui::EndMenu();
}

void draw_entry(PanelContext& context, const Action& action) {
  if (action.separator) ImGui::Separator();
  const std::string title = fmt::format("{}###{}", title_of(action, context.situation()), action.id);
  if (ImGui::MenuItem(title.c_str(), std::string(action.key).c_str(), is_ticked(context.state, action),
                      enabled(action, context.situation()))) {
    context.send(std::string(action.command));
  }
  context.items.record_last(fmt::format("menu:{}", action.id));
  if (!action.about.empty()) next_item_tooltip(std::string(action.about));
}

/// Actions that share a menu of their own within another one, by how their ids begin.
struct Submenu {
  std::string_view prefix;
  const char* title;
};
constexpr std::array<Submenu, 2> kSubmenus{{{"inside-", "Inside"}, {"from-", "Look from"}}};

const Submenu* submenu_of(const Action& action) {
  const auto* const at = std::ranges::find_if(kSubmenus, [&](const Submenu& one) { return action.id.starts_with(one.prefix); });
  return at == kSubmenus.end() ? nullptr : at;
}

void draw_submenu(PanelContext& context, const Submenu& submenu) {
  const bool open = ImGui::BeginMenu(submenu.title, context.state.in_space);
  context.items.record_last(fmt::format("menu:{}", submenu.title));
  if (!context.state.in_space) next_item_tooltip("of meshes of volume elements");
  if (!open) return;
  for (const Action& action : actions())
    if (submenu_of(action) == &submenu) draw_entry(context, action);
  ImGui::EndMenu();
}

/// Planar meshes, and below a line volumes.
void draw_samples(PanelContext& context) {
  const bool open = ImGui::BeginMenu("Samples");
  context.items.record_last("menu:Samples");
  if (!open) return;
  bool below_others = false;
  for (const Action& sample : actions()) {
    if (!sample.id.starts_with("sample-")) continue;
    if (std::exchange(below_others, true) && sample.separator) ImGui::Separator();
    const std::string name(sample.title.substr(sample.title.find(' ') + 1));
    if (ImGui::MenuItem(name.c_str())) context.send(std::string(sample.command));
    context.items.record_last(fmt::format("menu:{}", sample.id));
    const auto generator = std::ranges::find(generator_table(), name, &GeneratorInfo::name);
    if (generator != generator_table().end()) next_item_tooltip(std::string(generator->doc));
  }
  ImGui::EndMenu();
}

void draw_entries(PanelContext& context, std::string_view menu) {
  const bool had_sample = menu == "File";
  const Submenu* last = nullptr;
  for (const Action& action : actions()) {
    if (action.menu != menu || action.id.starts_with("sample-")) continue;
    if (const Submenu* submenu = submenu_of(action)) {
      if (submenu != last) draw_submenu(context, *submenu);
      last = submenu;
      continue;
    }
    draw_entry(context, action);
    if (action.id == "open" && had_sample) {
      draw_recent(context);
      draw_samples(context);
    }
  }
}

/// Space between groups of the tool bar.
void gap(const PanelContext& context) { ImGui::SameLine(0, context.px(18)); }

}  // namespace

float draw_menu(PanelContext& context) {
  float height = 0;
  if (ImGui::BeginMainMenuBar()) {
    for (const std::string_view menu : menu_names()) {
      const bool open = ImGui::BeginMenu(std::string(menu).c_str());
      context.items.record_last(fmt::format("menu:{}", menu));
      if (!open) continue;
      draw_entries(context, menu);
      ImGui::EndMenu();
    }
    height = ImGui::GetWindowSize().y;
    ImGui::EndMainMenuBar();
  }
  return height;
}

void draw_toolbar(PanelContext& context, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), (rect.h - ImGui::GetFrameHeight()) / 2});
  begin_panel("toolbar", rect);
  ImGui::PopStyleVar();
  action_button(context, "open", "Open…");
  gap(context);
  // Text first: what a button does must not be a riddle. Narrow windows get the shorter words.
  const bool wide = rect.w > 66 * context.em();
  const bool middling = rect.w > 50 * context.em();
  const bool busy = context.activity.busy;
  constexpr const char *kRun = "▶ Run", *kPause = "❚❚ Pause";
  action_button(context, "run-pause", busy ? kPause : kRun, context.session.input != nullptr, widest_button({kRun, kPause}));
  ImGui::SameLine();
  if (rect.w > 56 * context.em()) {
    action_button(context, "make-good", "Make it good");
    ImGui::SameLine();
  }
  action_button(context, "step-iteration", "Step");
  ImGui::SameLine();
  action_button(context, "back-iteration", "Back");
  if (middling) {
    ImGui::SameLine();
    action_button(context, "reset", "Reset");
  }
  if (wide) {
    gap(context);
    action_button(context, "step-class", "Class");
    ImGui::SameLine();
    action_button(context, "step-vertex", "Vertex");
  }
  gap(context);
  action_button(context, "fit", "Fit");
  ImGui::SameLine();
  constexpr const char *kWires = "Wires", *kWiresOn = "Wires ✓";
  action_button(context, "wireframe", context.state.wireframe ? kWiresOn : kWires, false, widest_button({kWires, kWiresOn}));
  if (!context.derived.metrics.empty()) {
    const float width = 12 * context.em();
    const float label = ImGui::CalcTextSize("shown").x + context.px(8);
    const float left = rect.w - context.px(12) - width;
    ImGui::SameLine();
    if (left - label > ImGui::GetCursorPosX() + context.px(8)) {
      ImGui::SetCursorPosX(left - label);
      ImGui::AlignTextToFramePadding();
      dim_text(context, "shown", false);
      ImGui::SameLine(left);
    } else {
      ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), left));
    }
    ImGui::SetNextItemWidth(std::min(width, ImGui::GetContentRegionAvail().x));
    metric_combo(context, "toolbar-shown", context.session.shown, "show");
  }
  end_panel();
}

}  // namespace dmoscope::ui
