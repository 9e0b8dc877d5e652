// Dialog for pictures of a run, for a video.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/commands/commands.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

std::uint64_t last_iteration(const PanelContext& context) {
  const RunView* run = context.run();
  return run == nullptr || run->records.empty() ? 0 : run->records.back().iteration;
}

std::string command_of(const SequenceDialog& widgets) {
  std::string line =
      fmt::format("sequence {} --from {} --to {} --every {}", quote_word(widgets.folder), widgets.from, widgets.to, widgets.every);
  if (widgets.window) {
    line += " --window";
  } else {
    line += fmt::format(" --size {}x{}", widgets.width, widgets.height);
  }
  return line + (widgets.overwrite ? " --overwrite" : "");
}

void draw_choices(PanelContext& context, SequenceDialog& widgets) {
  const int last = static_cast<int>(std::min<std::uint64_t>(last_iteration(context), 1'000'000'000));
  int range[2] = {widgets.from, widgets.to};
  row_label(context, "iterations", 9);
  if (ImGui::InputInt2("##range", range)) {
    widgets.from = std::clamp(range[0], 0, last);
    widgets.to = std::clamp(range[1], 0, last);
  }
  next_item_tooltip(fmt::format("first and last iteration, from 0 to {}", last));
  row_label(context, "every", 9);
  if (ImGui::InputInt("##every", &widgets.every)) widgets.every = std::max(1, widgets.every);
  next_item_tooltip("a picture of every iteration, every second one, ...; always one of the last");
  row_label(context, "what", 9);
  if (ImGui::RadioButton("the mesh", !widgets.window)) widgets.window = false;
  ImGui::SameLine();
  if (ImGui::RadioButton("the whole window", widgets.window)) widgets.window = true;
  if (!widgets.window) {
    int size[2] = {widgets.width, widgets.height};
    row_label(context, "size, pixels", 9);
    if (ImGui::InputInt2("##size", size)) {
      widgets.width = std::clamp(size[0], 1, 32768);
      widgets.height = std::clamp(size[1], 1, 32768);
    }
  }
  row_label(context, "old frames", 9);
  ImGui::Checkbox("replace those in the folder", &widgets.overwrite);
  context.items.record_last("sequence:overwrite");
}

}  // namespace

void draw_sequence_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Pictures of a run", 40)) return;
  SequenceDialog& widgets = context.widgets.sequence;
  if (context.widgets.dialog_opened) {
    widgets.from = 0;
    widgets.to = static_cast<int>(std::min<std::uint64_t>(last_iteration(context), 1'000'000'000));
    widgets.width = static_cast<int>(context.state.viewport.x) / 2 * 2;  // videos need even numbers
    widgets.height = static_cast<int>(context.state.viewport.y) / 2 * 2;
  }
  dim_text(context, "Shows one iteration after another and saves a picture of each: frame-0000.png, frame-0001.png, ...");
  ImGui::Spacing();
  row_label(context, "folder", 9);
  const bool entered = ImGui::InputText("##folder", &widgets.folder, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("sequence:folder");
  draw_choices(context, widgets);
  ImGui::Spacing();
  const auto pictures = widgets.to < widgets.from ? 0 : (widgets.to - widgets.from + widgets.every - 1) / widgets.every + 1;
  const bool go = ImGui::Button(fmt::format("Save {} picture{}###go", pictures, pictures == 1 ? "" : "s").c_str());
  context.items.record_last("sequence:go");
  ImGui::SameLine();
  close_button(context, "Cancel");
  if ((go || entered) && !widgets.folder.empty()) {
    context.state.dialog = Dialog::None;
    context.send(command_of(widgets));
  }
  end_dialog();
}

}  // namespace dmoscope::ui
