// Dialogs about unsaved work, and about sessions that were left behind.
#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// The buttons of a question, each of which sends a command. Enter presses the focused one, else the first.
class Answers {
 public:
  explicit Answers(PanelContext& context)
      : context_(context), enter_(ImGui::IsKeyPressed(key::kEnter, false) && !context.widgets.dialog_opened) {}

  /// Adds a button, on a line of its own if there is no room beside the one before.
  void add(const char* item, const char* label, const std::string& command) {
    const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (!first_.empty()) {
      ImGui::SameLine();
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    } else {
      first_ = command;
    }
    if (ImGui::Button(label)) chosen_ = command;
    if (enter_ && ImGui::IsItemFocused()) chosen_ = command;
    context_.items.record_last(item);
  }
  void send() {
    if (enter_ && chosen_.empty()) chosen_ = first_;
    if (!chosen_.empty()) context_.send(chosen_);
  }

 private:
  PanelContext& context_;
  bool enter_;
  std::string first_, chosen_;
};

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
  if (!context.state.leaving) {  // the dialog was opened by a command
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
    dim_text(context, question.lines.size() == 1 ? "Not saved yet:" : "These runs are not saved yet:");
    for (const std::string& line : question.lines) ImGui::TextUnformatted(line.c_str());
  }
  if (!question.running.empty()) {
    ImGui::Spacing();
    ImGui::TextColored(colour_vector(context.palette.warning), "%s", question.running.c_str());
  }
  ImGui::PopTextWrapPos();
  context.items.record_last("unsaved:text");
  ImGui::Spacing();
  Answers answers(context);
  answers.add("unsaved:session", "Save session…", "answer session");
  answers.add("unsaved:export", "Export mesh…", "answer export");
  answers.add("unsaved:discard", "Discard", "answer discard");
  answers.add("unsaved:cancel", "Cancel", "answer cancel");
  answers.send();
  end_dialog();
}

void draw_recover_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Recover", 46)) return;
  const std::vector<Recoverable>& found = context.state.recoverable;
  if (context.state.dialog == Dialog::None) context.send("recovery later");  // closed by Escape
  if (found.empty()) {
    context.state.dialog = Dialog::None;
    end_dialog();
    return;
  }
  std::size_t& chosen = context.widgets.recover.chosen;
  chosen = std::min(chosen, found.size() - 1);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(found.size() == 1 ? "A window ended before its work was saved:"
                                           : "Several windows ended before their work was saved:");
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
    note_item(context, fmt::format("recover:{}", k), found[k].mesh);
    ImGui::PopID();
  }
  ImGui::Spacing();
  const std::string place = std::to_string(chosen + 1);
  Answers answers(context);
  answers.add("recover:take", "Recover", "recovery take " + place);
  answers.add("recover:discard", "Discard", "recovery discard " + place);
  answers.add("recover:later", "Later", "recovery later");
  next_item_tooltip("asks again at the next start");
  answers.send();
  end_dialog();
}

}  // namespace dmoscope::ui
