// Menu bar and tool bar, both from the table of actions.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/mesh/generate.h"
#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/view_options.h"

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

/// Groups of actions that are submenus of a menu.
struct Nested {
  std::string_view menu, within;
};
constexpr std::array<Nested, 9> kNested{{{"Timeline", "Run"},
                                         {"Play", "Run"},
                                         {"Marks A and B", "Run"},
                                         {"Stepping", "Run"},
                                         {"Inspect", "Run"},
                                         {"Inside", "View"},
                                         {"Look from", "View"},
                                         {"Plot", "View"},
                                         {"Colours", "View"}}};

bool is_nested(std::string_view menu) { return std::ranges::find(kNested, menu, &Nested::menu) != kNested.end(); }

/// Draws the samples: planar meshes, and below a line volumes.
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
  for (const Action& action : actions()) {
    if (action.menu != menu || action.id.starts_with("sample-")) continue;
    if (action.id.starts_with("unfold-") && !context.widgets.narrow) continue;  // columns beside the mesh are not unfolded
    draw_entry(context, action);
    if (action.id == "open" && had_sample) {
      draw_recent(context);
      draw_samples(context);
    }
  }
  for (const Nested& nested : kNested) {
    if (nested.within != menu) continue;
    if (nested.menu == std::ranges::find(kNested, menu, &Nested::within)->menu) ImGui::Separator();
    const bool possible = context.state.in_space || (nested.menu != "Inside" && nested.menu != "Look from");
    const bool open = ImGui::BeginMenu(std::string(nested.menu).c_str(), possible);
    context.items.record_last(fmt::format("menu:{}", nested.menu));
    if (!possible) next_item_tooltip("for meshes of volume elements");
    if (!open) continue;
    draw_entries(context, nested.menu);
    ImGui::EndMenu();
  }
}

/// A button of the tool bar: an icon that everybody knows, or a word, with an icon where one tells more.
struct Tool {
  const char* id;
  std::string_view icon;
  const char* word = "";
  bool gap = false;             // whether there is a gap before it
  float least = 0;              // least width of the tool bar that has room for it, in heights of the font
  const char* other_word = "";  // word while work is done
  bool joined = false;          // whether it is one with the tool before it
};
constexpr std::array<Tool, 10> kTools{{{"open", Icon::kOpen, "", false, 44},
                                       {"undo", Icon::kUndo, "", true, 47},
                                       {"redo", Icon::kRedo, "", false, 47},
                                       {"back-iteration", Icon::kBack, "", true},
                                       {"step-iteration", Icon::kStep, "Iteration"},
                                       {"step-class", {}, "Colour class", false, 50, "", true},
                                       {"step-vertex", {}, "Vertex", false, 50, "", true},
                                       {"run-pause", Icon::kPlay, "Run", true, 0, "Pause"},
                                       {"make-good", Icon::kSpark, "Make it good", false, 40},
                                       {"reset", Icon::kReset, "Reset", false, 36}}};

float icon_side() { return std::round(1.1F * ImGui::GetFontSize()); }

float width_of(const Tool& tool) {
  const float words = std::max(ImGui::CalcTextSize(tool.word).x, ImGui::CalcTextSize(tool.other_word).x);
  if (words == 0) return std::round(1.15F * ImGui::GetFrameHeight());
  const float icon = !tool.icon.empty() ? icon_side() + ImGui::GetStyle().ItemInnerSpacing.x : 0.0F;
  return words + icon + 2 * ImGui::GetStyle().FramePadding.x;
}

float gap_before(const PanelContext& context, const Tool& tool) { return context.px(tool.joined ? 1.0F : tool.gap ? 16.0F : 4.0F); }

void draw_tool(PanelContext& context, const Tool& tool) {
  const Action& action = *find_action(tool.id);
  const bool works = context.activity.busy && *tool.other_word != 0;
  const bool primary = *tool.other_word != 0 && context.session.input != nullptr;
  const char* word = works ? tool.other_word : tool.word;
  if (tool.joined) {  // fills the rounded corners between the two
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float half = ImGui::GetStyle().FrameRounding, gap = gap_before(context, tool);
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Button);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - gap - half, at.y}, {at.x - gap, at.y + ImGui::GetFrameHeight()}, ink);
    list.AddRectFilled(at, {at.x + half, at.y + ImGui::GetFrameHeight()}, ink);
  }
  action_button(context, tool.id, fmt::format("##{}", tool.id).c_str(), primary, width_of(tool));
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const bool possible = enabled(action, context.situation());
  const render::Rgb ink = primary ? context.palette.on_accent : context.palette.text;
  const ImU32 shade = colour(ink, possible ? 1.0F : ImGui::GetStyle().DisabledAlpha);
  const float text = ImGui::CalcTextSize(word).x, side = !tool.icon.empty() ? icon_side() : 0.0F;
  const float between = side > 0 && text > 0 ? ImGui::GetStyle().ItemInnerSpacing.x : 0.0F;
  const float left = std::round((low.x + high.x - side - between - text) / 2), middle = std::round((low.y + high.y) / 2);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (side > 0) draw_icon(list, works ? Icon::kPause : tool.icon, {left + side / 2, middle}, side, shade);
  list.AddText({left + side + between, std::round(middle - ImGui::GetTextLineHeight() / 2)}, shade, word);
}

/// Draws the choice of the shown metric and the search of commands at the right end if there is room.
void draw_right_end(PanelContext& context, const Rect& rect) {
  const float width = 11 * context.em(), side = ImGui::GetFrameHeight(), gap = context.px(8);
  ImGui::SameLine(0, gap);
  const float from = ImGui::GetCursorPosX(), search = rect.w - gap - side, left = search - gap - width;
  if (search < from) return;
  ImGui::SetCursorPosX(search);
  action_icon(context, "palette", Icon::kSearch, {side, side});
  ImGui::SameLine();
  if (context.derived.metrics.empty() || left < from) return;
  ImGui::SetCursorPosX(left);
  ImGui::SetNextItemWidth(width);
  metric_combo(context, "toolbar-shown", context.session.shown, "show");
}

}  // namespace

HeaderSize header_size(const PanelContext& context) {
  HeaderSize size{context.em(), context.px(8), context.px(20)};
  for (const std::string_view menu : menu_names())
    if (!is_nested(menu)) size.menu += std::floor(ImGui::CalcTextSize(std::string(menu).c_str()).x + 2 * ImGui::GetStyle().ItemSpacing.x);
  for (const Tool& tool : kTools) size.tools += width_of(tool) + gap_before(context, tool);
  return size;
}

void draw_menu(PanelContext& context, const Rect& rect) {
  const float above = (rect.h - context.em()) / 2;
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(4), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {context.px(8), std::floor(above)});
  ImGui::Begin("menu", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_MenuBar);
  const bool bar = ImGui::BeginMenuBar();
  ImGui::PopStyleVar(2);
  ImGui::SetCursorPosY(std::round(above) - std::floor(above));  // the words stand as those of the tools
  for (const std::string_view menu : menu_names()) {
    if (is_nested(menu)) continue;
    const bool open = bar && ImGui::BeginMenu(std::string(menu).c_str());
    context.items.record_last(fmt::format("menu:{}", menu));
    if (!open) continue;
    draw_entries(context, menu);
    ImGui::EndMenu();
  }
  if (bar) ImGui::EndMenuBar();
  ImGui::End();
}

void draw_toolbar(PanelContext& context, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(10), (rect.h - ImGui::GetFrameHeight()) / 2});
  begin_panel("toolbar", rect);
  ImGui::PopStyleVar();
  float end = 0;  // right end of the last tool
  for (const Tool& tool : kTools) {
    if (rect.w < tool.least * context.em()) continue;
    if (end > 0) ImGui::SameLine(0, gap_before(context, tool));
    draw_tool(context, tool);
    end = ImGui::GetItemRectMax().x;
  }
  draw_right_end(context, rect);
  end_panel();
}

}  // namespace dmoscope::ui
