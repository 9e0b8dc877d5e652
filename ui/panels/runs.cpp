// The runs, in a list that scrolls by itself and keeps its height, so that nothing below it moves.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/smooth/execution/method_table.h"
#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

/// Statistics of the run's present moment: within an iteration, and after edits, its last record is of another one.
const Statistics* statistics_of(const PanelContext& context, std::size_t k) {
  const RunView& run = context.session.runs[k];
  const Frame* frame = context.frame();
  if (frame != nullptr && frame->run == k && k == context.session.active && frame->moment == run.moment && !frame->provisional)
    return &frame->statistics;
  if (run.records.empty()) return nullptr;
  for (const IterationRecord& one : run.records)
    if (one.iteration == run.moment.iteration) return &one.statistics;
  return &run.records.back().statistics;
}

/// Text of the minimum, by the run's own metric.
std::string minimum_of(const PanelContext& context, std::size_t k) {
  const Statistics* statistics = statistics_of(context, k);
  return statistics == nullptr ? std::string() : short_number(statistics->minimum);
}

std::string tooltip_of(const PanelContext& context, std::size_t k) {
  const RunView& run = context.session.runs[k];
  std::string tip = run_title(context.session, k);
  if (context.session.several_meshes()) tip += "\non " + context.session.runs[k].input->mesh.name;
  if (const Statistics* statistics = statistics_of(context, k))
    tip += fmt::format("\niteration {}: minimum {}, mean {}", count(run.moment.iteration), short_number(statistics->minimum),
                       short_number(statistics->mean));
  if (!run.last_outcome.empty()) tip += "\n" + run.last_outcome;
  if (run.summary && run.summary->sizes.known())
    tip += "\ncorrelation of edge length and target size: " +
           size_course_text(run.summary->sizes.before.sizes, run.summary->sizes.after.sizes);
  return tip + "\ndouble click renames it";
}

bool is_hidden(const PanelContext& context, std::size_t k) { return context.state.panes.hidden_runs.contains(context.session.runs[k].id); }

void draw_run_menu(PanelContext& context, std::size_t k) {
  if (!ImGui::BeginPopupContextItem("run menu")) return;
  const std::string number = std::to_string(k + 1);
  if (ImGui::MenuItem("Rename…", "F2")) context.send("begin-rename " + number);
  context.items.record_last("run-menu:rename");
  if (ImGui::MenuItem(is_hidden(context, k) ? "Show in plots and viewports" : "Hide in plots and viewports"))
    context.send("hide-run " + number);
  context.items.record_last("run-menu:hide");
  if (ImGui::MenuItem("Hide all except the active run")) context.send("hide-run others");
  if (ImGui::MenuItem("Show all runs", nullptr, false, !context.state.panes.hidden_runs.empty())) context.send("hide-run none");
  ImGui::Separator();
  if (ImGui::MenuItem("Remove", nullptr, false, context.session.runs.size() > 1 && !context.activity.busy))
    context.send("remove-run " + number);
  context.items.record_last("run-menu:remove");
  ImGui::EndPopup();
}

/// Draws a field for the name in place of the title. Enter, or a click elsewhere, takes the name; Escape leaves it as it was.
void draw_name_field(PanelContext& context, std::size_t k, float width) {
  RunListState& list = context.widgets.run_list;
  const RunView& run = context.session.runs[k];
  const bool begins = std::exchange(list.renamed, run.id) != run.id;
  if (begins) {
    list.name = run.title;
    ImGui::SetKeyboardFocusHere();
    ImGui::SetScrollHereY();
  }
  ImGui::SetNextItemWidth(width);
  const bool entered = ImGui::InputText("##name", &list.name, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  context.items.record_last("run-name");
  if (!entered && !ImGui::IsItemDeactivated()) return;
  context.state.renaming_run.reset();
  list.renamed = 0;
  const bool changed = list.name != run.title && !ImGui::IsKeyPressed(key::kEscape, false);
  if (changed) context.send(fmt::format("rename-run {} {}", k + 1, quote_word(list.name)));
}

void draw_row_buttons(PanelContext& context, std::size_t k, ImVec2 corner, float side, float height) {
  const std::string number = std::to_string(k + 1);
  const bool hidden = is_hidden(context, k);
  ImGui::SetCursorScreenPos(corner);
  if (icon_button(context, "run-eye:" + number, hidden ? Icon::kEyeOff : Icon::kEye, {side, height},
                  hidden ? "shows it in plots and viewports again" : "hides it in plots and viewports"))
    context.send("hide-run " + number);
  ImGui::SetCursorScreenPos({corner.x + side, corner.y});
  const bool possible = context.session.runs.size() > 1 && !context.activity.busy;
  ImGui::BeginDisabled(!possible);
  if (icon_button(context, "run-remove:" + number, Icon::kCross, {side, height},
                  context.session.runs.size() > 1 ? "removes it; Ctrl+Z brings it back" : "the last run cannot be removed"))
    context.send("remove-run " + number);
  ImGui::EndDisabled();
}

/// Name of a run as over its viewport; differences that one line has no room for stand in a second one.
struct RowText {
  std::string first, second;
  RowText(const RunName& name, bool only, float room, float second_room) : first((only ? "" : name.number + " ") + name.method_and_aim()) {
    const auto fits = [room](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x <= room; };
    const std::string others = name.other_differences(), both = first + (others.empty() ? "" : ", " + others);
    if (fits(both)) {
      first = both;
    } else if (name.given || (fits(first) && !others.empty())) {
      second = others;
    } else {
      first = fit_text((only ? "" : name.number + " ") + name.method, room);
      second = name.aim + (others.empty() ? "" : ", " + others);
    }
    first = fit_text(first, room);
    second = fit_text(second, second_room / kSmaller);
  }
  static constexpr float kSmaller = 0.87F;  // size of the second line's letters
};

void draw_run_row(PanelContext& context, const RunName& name, std::size_t k, float width) {
  const RunView& run = context.session.runs[k];
  ImGui::PushID(static_cast<int>(k));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight(), row = std::round(1.6F * line), side = line;
  const bool active = k == context.session.active, hidden = is_hidden(context, k);
  const std::string minimum = minimum_of(context, k);
  const float bar = context.px(4), text = at.x + bar + context.px(6), buttons = at.x + width - 2 * side;
  const float number = buttons - context.px(4) - ImGui::CalcTextSize(minimum.c_str()).x, room = number - context.px(4) - text;
  const RowText words(name, context.session.runs.size() == 1, room, at.x + width - text);
  const float height = row + (words.second.empty() ? 0.0F : std::round(0.8F * line));
  if (context.state.renaming_run == run.id) {
    ImGui::SetCursorScreenPos({text, at.y});
    draw_name_field(context, k, room);
    ImGui::SetCursorScreenPos(at);
  } else {
    const bool pressed = ImGui::Selectable("##run", active, ImGuiSelectableFlags_AllowItemOverlap, {width, height});
    context.items.record_last(fmt::format("run:{}", k));
    const bool on_text = ImGui::IsItemHovered() && ImGui::GetIO().MousePos.x < buttons;
    if (on_text) context.widgets.run_list.over = k + 1;
    const bool twice = on_text && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (on_text) next_item_tooltip(tooltip_of(context, k));
    draw_run_menu(context, k);
    if (twice)
      context.send(fmt::format("begin-rename {}", k + 1));
    else if (pressed && !active)
      context.send(fmt::format("select-run {}", k + 1));
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float pad = context.px(3), y = std::round(at.y + (row - line) / 2);
  list.AddRectFilled({at.x, at.y + pad}, {at.x + bar, at.y + height - pad}, colour(context.palette.run(k), hidden ? 0.35F : 1.0F), bar / 2);
  const ImU32 ink = colour(hidden ? context.palette.dim : context.palette.text);
  if (context.state.renaming_run != run.id) list.AddText({text, y}, ink, words.first.c_str());
  if (!words.second.empty())
    list.AddText(context.fonts.body, RowText::kSmaller * context.em(), {text, y + line}, colour(context.palette.dim), words.second.c_str());
  list.AddText({number, y}, ink, minimum.c_str());
  draw_row_buttons(context, k, {buttons, at.y}, side, row);
  ImGui::SetCursorScreenPos({at.x, at.y + height});
  ImGui::PopID();
}

void draw_add(PanelContext& context) {
  const char* add = "+ add";
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(add).x - 2 * ImGui::GetStyle().FramePadding.x);
  const RunView* run = context.run();
  ImGui::BeginDisabled(run == nullptr || context.activity.busy);
  if (ImGui::SmallButton(add)) ImGui::OpenPopup("add run");
  context.items.record_last("add-run");
  ImGui::EndDisabled();
  next_item_tooltip("adds a run on the same input, for comparison");
  if (!ImGui::BeginPopup("add run")) return;
  const std::string own(info(run->parameters.metric).name);
  dim_text(context, "new run with the same method and this metric", false);
  for (const Metric metric : context.derived.metrics) {
    if (ImGui::MenuItem(metric_title(metric).c_str()))
      context.send(fmt::format("add-run {}:{}", run->parameters.method, info(metric).name));
    context.items.record_last(fmt::format("add-run:{}", info(metric).name));
  }
  ImGui::Separator();
  dim_text(context, "new run with the same metric and this method", false);
  for (const MethodInfo& method : method_table()) {
    if (ImGui::MenuItem(std::string(method.name).c_str())) context.send(fmt::format("add-run {}:{}", method.name, own));
    note_item(context, fmt::format("add-run:{}", method.name), std::string(method.doc));
  }
  ImGui::Separator();
  const Action& several = *find_action("compare-runs");
  if (ImGui::MenuItem(std::string(several.title).c_str())) context.send(std::string(several.command));
  context.items.record_last("add-run:several");
  ImGui::EndPopup();
}

}  // namespace

void draw_runs(PanelContext& context) {
  const std::vector<RunView>& runs = context.session.runs;
  heading(context, runs.size() > 1 ? fmt::format("Runs ({})", runs.size()).c_str() : "Runs");
  next_item_tooltip("each run with its worst element, by the metric that the run optimises");
  const bool by_others = std::ranges::any_of(runs, [&](const RunView& run) { return run.parameters.metric != context.session.shown; });
  if (by_others) {
    ImGui::SameLine();
    dim_text(context, "by its own metric", false);
  }
  ImGui::SameLine();
  draw_add(context);
  RunListState& state = context.widgets.run_list;
  if (context.state.renaming_run && std::ranges::find(runs, *context.state.renaming_run, &RunView::id) == runs.end())
    context.state.renaming_run.reset();
  if (!context.state.renaming_run) state.renamed = 0;
  const float height = static_cast<float>(context.state.panels.runs_height) * context.em();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("run list", {width, height});
  context.items.record(
      "run-list", {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowPos().x + width, ImGui::GetWindowPos().y + height});
  state.over = 0;
  if (runs.empty()) dim_text(context, "no runs yet: open a mesh");
  // The list's scroll bar always has its place, so that no button moves when it appears.
  const float row_width = width - ImGui::GetStyle().ScrollbarSize;
  const std::uint64_t active = context.run() == nullptr ? 0 : context.run()->id;
  const bool other = std::exchange(state.active, active) != active;
  const std::vector<RunName> names = run_names(context.session);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const float top = ImGui::GetCursorPosY();
    draw_run_row(context, names[k], k, row_width);
    const float bottom = ImGui::GetCursorPosY(), scroll = ImGui::GetScrollY();
    if (other && runs[k].id == active && (top < scroll || bottom > scroll + height))
      ImGui::SetScrollFromPosY(top - scroll + (bottom - top) / 2, 0.5F);
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  const ImVec2 below = ImGui::GetCursorScreenPos();
  const float grip = context.px(6);
  splitter_grip(context, {"runs", {below.x, below.y, width, grip}, false, 1, &Panels::runs_height, 3, 40});
}

}  // namespace dmoscope::ui
