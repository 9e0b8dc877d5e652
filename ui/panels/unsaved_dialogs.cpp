// What would be lost, and what was left behind.
#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// A button that answers by a command; on a line of its own where there is no room beside the one before.
void answer_button(PanelContext& context, const char* item, const char* label, const std::string& command, bool first = false) {
  const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
  if (!first) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  }
  if (ImGui::Button(label)) context.send(command);
  context.items.record_last(item);
}

/// Enter presses the first button, unless the keyboard has gone on to another one.
bool entered() { return !ImGui::GetIO().NavVisible && ImGui::IsKeyPressed(key::kEnter, false); }

std::string clock_text(std::int64_t when) {
  const auto time = static_cast<std::time_t>(when);
  std::tm parts{};
  if (localtime_r(&time, &parts) == nullptr) return {};
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday, parts.tm_hour, parts.tm_min);
}

std::string row_of(const Recoverable& one) {
  const std::string name = one.mesh.empty() ? "a session" : std::filesystem::path(one.mesh).filename().string();
  const std::string runs = one.runs == 1 ? std::string() : fmt::format(", {} runs", one.runs);
  return fmt::format("{}   iteration {}{}   {}", name, count(one.iteration), runs, clock_text(one.when));
}

}  // namespace

void draw_unsaved_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Not saved", 42)) return;
  if (!context.state.leaving) {  // opened by hand
    context.state.dialog = Dialog::None;
    end_dialog();
    return;
  }
  const Activity& activity = context.activity;
  const UnsavedQuestion question = unsaved_question(context.session, *context.state.leaving, activity.busy, activity.command);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(question.title.c_str());
  ImGui::Spacing();
  if (!question.lines.empty()) {
    dim_text(context, question.lines.size() == 1 ? "In no file yet:" : "In no file yet are these runs:");
    for (const std::string& line : question.lines) ImGui::TextUnformatted(line.c_str());
  }
  if (!question.running.empty()) {
    ImGui::Spacing();
    ImGui::TextColored(colour_vector(context.palette.warning), "%s", question.running.c_str());
  }
  ImGui::PopTextWrapPos();
  context.items.record_last("unsaved:text");
  ImGui::Spacing();
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  answer_button(context, "unsaved:session", "Save session…", "answer session", true);
  answer_button(context, "unsaved:export", "Export mesh…", "answer export");
  answer_button(context, "unsaved:discard", "Discard", "answer discard");
  answer_button(context, "unsaved:cancel", "Cancel", "answer cancel");
  if (entered() && !context.widgets.dialog_opened) context.send("answer session");
  end_dialog();
}

void draw_recover_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Recover", 46)) return;
  const std::vector<Recoverable>& found = context.state.recoverable;
  if (context.state.dialog == Dialog::None) context.send("recovery later");  // Escape
  if (found.empty()) {
    context.state.dialog = Dialog::None;
    end_dialog();
    return;
  }
  std::size_t& chosen = context.widgets.recover.chosen;
  chosen = std::min(chosen, found.size() - 1);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(found.size() == 1 ? "A window ended before its work was saved. What it had come to:"
                                           : "Windows ended before their work was saved. What they had come to:");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  for (std::size_t k = 0; k < found.size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    const std::string row = fit_text(row_of(found[k]), ImGui::GetContentRegionAvail().x - 2 * context.em());
    if (found.size() == 1) {
      ImGui::TextUnformatted(row.c_str());
    } else if (ImGui::RadioButton(row.c_str(), chosen == k)) {
      chosen = k;
    }
    context.items.record_last(fmt::format("recover:{}", k));
    next_item_tooltip(found[k].mesh);
    ImGui::PopID();
  }
  ImGui::Spacing();
  const std::string place = std::to_string(chosen + 1);
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  answer_button(context, "recover:take", "Recover", "recovery take " + place, true);
  answer_button(context, "recover:discard", "Discard", "recovery discard " + place);
  answer_button(context, "recover:later", "Later", "recovery later");
  next_item_tooltip("the next start asks again");
  if (entered() && !context.widgets.dialog_opened) context.send("recovery take " + place);
  end_dialog();
}

}  // namespace dmoscope::ui
