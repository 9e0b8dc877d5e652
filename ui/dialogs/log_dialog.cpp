// Log of commands and messages (F6), and the script made from it.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/commands/commands.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

const char* state_word(LogLine::State state) {
  constexpr std::array<const char*, 5> kWords{"  (waits or runs)", "", "  (failed)", "  (cancelled)", "  (cancelled before it began)"};
  return kWords[static_cast<std::size_t>(state)];  // in the order of State
}

render::Rgb ink_of(const PanelContext& context, const LogLine& line) {
  if (line.kind == LogLine::Kind::Error || line.state == LogLine::State::Failed) return context.palette.error;
  if (line.kind == LogLine::Kind::Warning || line.state == LogLine::State::Cancelled) return context.palette.warning;
  return line.kind == LogLine::Kind::Command ? context.palette.text : context.palette.dim;
}

std::vector<const LogLine*> wanted_lines(const PanelContext& context) {
  const LogDialog& widgets = context.widgets.log;
  const std::vector<std::string> words = search_words(widgets.filter);
  std::vector<const LogLine*> lines;
  for (const LogLine& line : context.state.commands.lines()) {
    const bool command = line.kind == LogLine::Kind::Command;
    if (command ? !widgets.commands : !widgets.messages) continue;
    if (words.empty() || holds_all(line.text, words)) lines.push_back(&line);
  }
  return lines;
}

void draw_line(PanelContext& context, const LogLine& line) {
  dim_text(context, line.time, false);
  ImGui::SameLine(5.5F * context.em());
  const bool command = line.kind == LogLine::Kind::Command;
  // Commands have a mark, too, because not everybody can tell them by colour.
  ImGui::TextColored(colour_vector(context.palette.accent), command ? "▸" : " ");
  ImGui::SameLine(7.0F * context.em());
  const std::string text = context.shown(line.text.substr(0, line.text.find('\n'))) + state_word(line.state);
  const std::string shown = fit_text(text, ImGui::GetContentRegionAvail().x);
  ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(ink_of(context, line)));
  if (ImGui::Selectable(shown.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) context.state.requests.clipboard = line.text;
  ImGui::PopStyleColor();
  next_item_tooltip((shown != text || line.text.find('\n') != std::string::npos ? context.shown(line.text) + "\n" : "") +
                    "(click copies it)");
}

void draw_lines(PanelContext& context, const std::vector<const LogLine*>& lines) {
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(lines.size()));
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      ImGui::PushID(k);
      draw_line(context, *lines[static_cast<std::size_t>(k)]);
      context.items.record_last(fmt::format("log:{}", k));
      ImGui::PopID();
    }
  }
  if (lines.empty()) dim_text(context, "nothing to show");
  std::size_t& seen = context.widgets.log.seen;
  if (context.widgets.dialog_opened || seen != lines.size()) ImGui::SetScrollHereY(1.0F);
  seen = lines.size();
}

void draw_log_filter(PanelContext& context) {
  LogDialog& widgets = context.widgets.log;
  ImGui::SetNextItemWidth(18 * context.em());
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextWithHint("##filter", "filter", &widgets.filter);
  context.items.record_last("log:filter");
  ImGui::SameLine(0, context.px(16));
  ImGui::Checkbox("commands", &widgets.commands);
  context.items.record_last("log:commands");
  ImGui::SameLine(0, context.px(16));
  ImGui::Checkbox("messages", &widgets.messages);
  context.items.record_last("log:messages");
}

}  // namespace

void draw_log_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Log", 60, 40)) return;
  draw_log_filter(context);
  const std::vector<const LogLine*> lines = wanted_lines(context);
  ImGui::BeginChild("lines", {0, -2 * ImGui::GetFrameHeightWithSpacing()});
  draw_lines(context, lines);
  ImGui::EndChild();
  LogDialog& widgets = context.widgets.log;
  const bool save = ImGui::Button("Save as script");
  note_item(context, "log:save", "a script that repeats these steps: dmoscope script FILE");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputText("##script", &widgets.script_name, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("log:file");
  if ((save || entered) && !widgets.script_name.empty()) context.send("save-script " + quote_word(widgets.script_name));
  if (ImGui::Button("Copy all")) {
    std::string text;
    for (const LogLine* line : lines) text += line->text + "\n";
    context.state.requests.clipboard = std::move(text);
  }
  note_item(context, "log:copy", "copies the lines above to the clipboard");
  ImGui::SameLine();
  close_button(context, "Close");
  end_dialog();
}

}  // namespace dmoscope::ui
