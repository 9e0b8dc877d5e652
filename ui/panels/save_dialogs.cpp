// Export of the mesh and its numbers, and screenshots.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/commands/commands.h"
#include "core/io/atomic_file.h"
#include "core/io/mesh_io.h"
#include "core/session/original_copy.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommands[] = {"export", "stats", "elements"};

std::string default_name(const PanelContext& context, int what) {
  const Frame* frame = context.frame();
  if (frame == nullptr) return {};
  fs::path path = frame->input->path;
  std::error_code ignored;
  if (path.empty()) path = fs::current_path(ignored) / (fs::path(frame->input->mesh.name).stem().string() + ".vtk");
  const std::string stem = path.stem().string();
  const std::string name = what == 0 ? stem + "-smoothed" + path.extension().string() : stem + (what == 1 ? "-stats.csv" : "-elements.csv");
  return path.replace_filename(name).string();
}

void draw_formats(PanelContext& context, std::string& name) {
  const std::string now = fs::path(name).extension().string();
  const FormatInfo* current = nullptr;
  const auto has = [&](const FormatInfo& format) {
    return fmt::format(" {} ", format.extensions).find(fmt::format(" {} ", now)) != std::string::npos;
  };
  for (const FormatInfo& format : format_table()) {
    if (has(format)) current = &format;
  }
  ImGui::AlignTextToFramePadding();
  dim_text(context, "format", false);
  ImGui::SameLine(6 * context.em());
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##format", current == nullptr ? "by the file's name" : std::string(current->title).c_str())) {
    for (const FormatInfo& format : format_table()) {
      const std::string label = fmt::format("{}   {}", format.title, format.extensions);
      if (ImGui::Selectable(label.c_str(), &format == current)) {
        const std::string extensions(format.extensions);
        name = fs::path(name).replace_extension(extensions.substr(0, extensions.find(' '))).string();
      }
      next_item_tooltip(std::string(format.doc));
    }
    ImGui::EndCombo();
  }
  if (current != nullptr) dim_text(context, std::string(current->doc));
}

void say_if_replaced(PanelContext& context, const std::string& name) {
  std::error_code ignored;
  if (!name.empty() && fs::exists(name, ignored)) {
    ImGui::TextColored(colour_vector(context.palette.warning), "This file is there already and will be replaced.");
  }
}

/// Whether the export would take the place of the file that the mesh was read from, by whatever name.
bool writes_over_input(const PanelContext& context) {
  const ExportDialog& dialog = context.widgets.exporting;
  const Frame* frame = context.frame();
  return dialog.what == 0 && frame != nullptr && same_file(dialog.name, frame->input->path);
}

/// In the place of the dialog's buttons.
void ask_over_input(PanelContext& context) {
  ExportDialog& dialog = context.widgets.exporting;
  const std::string copy = original_name(context.frame()->input->path, 1).filename().string();
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(colour_vector(context.palette.warning),
                     "This is the file that the mesh was read from. It will hold the smoothed mesh then; what it holds now is kept beside "
                     "it as %s (or under the next number).",
                     copy.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  const bool go = ImGui::Button("Write over it, keep a copy");
  context.items.record_last("export:over");
  ImGui::SameLine();
  if (ImGui::Button("Back")) dialog.over_input = false;
  context.items.record_last("export:back");
  if (!go) return;
  context.state.dialog = Dialog::None;
  context.send("export-over " + quote_word(dialog.name));
}

}  // namespace

void draw_export_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Export", 44)) return;
  WidgetState& widgets = context.widgets;
  if (widgets.dialog_opened) {
    widgets.exporting.what = 0;
    widgets.exporting.name = default_name(context, 0);
    widgets.exporting.over_input = false;
  }
  if (widgets.exporting.over_input) {
    ask_over_input(context);
    end_dialog();
    return;
  }
  constexpr const char* kWhat[] = {"mesh as it is now", "statistics of all runs", "quality of every element"};
  for (int k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine(0, context.px(16));
    if (ImGui::RadioButton(kWhat[k], widgets.exporting.what == k)) {
      widgets.exporting.what = k;
      widgets.exporting.name = default_name(context, k);
    }
  }
  ImGui::AlignTextToFramePadding();
  dim_text(context, "file", false);
  ImGui::SameLine(6 * context.em());
  ImGui::SetNextItemWidth(-1);
  if (widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  if (widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputText("##file", &widgets.exporting.name, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("export:file");
  if (widgets.exporting.what == 0) draw_formats(context, widgets.exporting.name);
  say_if_replaced(context, widgets.exporting.name);
  ImGui::Spacing();
  const bool go = ImGui::Button("Export");
  context.items.record_last("export:go");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) context.state.dialog = Dialog::None;
  context.items.record_last("dialog:close");
  if ((go || entered) && writes_over_input(context)) {
    widgets.exporting.over_input = true;
  } else if ((go || entered) && !widgets.exporting.name.empty()) {
    context.state.dialog = Dialog::None;
    context.send(fmt::format("{} {}", kCommands[widgets.exporting.what], quote_word(widgets.exporting.name)));
  }
  end_dialog();
}

void draw_save_session_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Save the session", 44)) return;
  std::string& name = context.widgets.save_session.name;
  if (context.widgets.dialog_opened) {
    if (name.empty()) name = fs::path(default_name(context, 1)).replace_filename("session").string() + std::string(kSessionExtension);
    ImGui::SetKeyboardFocusHere();
  }
  dim_text(context,
           "The runs with their histories, where they stand, and the view. The mesh's own file stays where it is and is read again.");
  ImGui::Spacing();
  ImGui::AlignTextToFramePadding();
  dim_text(context, "file", false);
  ImGui::SameLine(6 * context.em());
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputText("##file", &name, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("session:file");
  if (!name.empty() && !is_session_name(name)) dim_text(context, "without .dmoscope at its end the open dialog will not list it");
  say_if_replaced(context, name);
  ImGui::Spacing();
  const bool go = ImGui::Button("Save");
  context.items.record_last("session:go");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) context.state.dialog = Dialog::None;
  context.items.record_last("dialog:close");
  if ((go || entered) && !name.empty()) {
    context.state.dialog = Dialog::None;
    context.send("save-session " + quote_word(name));
  }
  end_dialog();
}

void draw_screenshot_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Screenshot", 40)) return;
  WidgetState& widgets = context.widgets;
  if (widgets.dialog_opened) {
    widgets.screenshot.width = static_cast<int>(context.state.viewport.x);
    widgets.screenshot.height = static_cast<int>(context.state.viewport.y);
  }
  const auto label = [&](const char* text) {
    ImGui::AlignTextToFramePadding();
    dim_text(context, text, false);
    ImGui::SameLine(8 * context.em());
    ImGui::SetNextItemWidth(-1);
  };
  label("file (.png)");
  const bool entered = ImGui::InputText("##file", &widgets.screenshot.name, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("screenshot:file");
  label("what");
  if (ImGui::RadioButton("the mesh", !widgets.screenshot.window)) widgets.screenshot.window = false;
  ImGui::SameLine();
  if (ImGui::RadioButton("the whole window", widgets.screenshot.window)) widgets.screenshot.window = true;
  if (!widgets.screenshot.window) {
    int size[2] = {widgets.screenshot.width, widgets.screenshot.height};
    label("size, pixels");
    if (ImGui::InputInt2("##size", size)) {
      widgets.screenshot.width = std::clamp(size[0], 1, 32768);
      widgets.screenshot.height = std::clamp(size[1], 1, 32768);
    }
    label("supersample");
    ImGui::SliderInt("##supersample", &widgets.screenshot.supersample, 1, 8, "%d", ImGuiSliderFlags_AlwaysClamp);
    next_item_tooltip("samples a pixel: smoother edges");
    label("background");
    ImGui::Checkbox("transparent", &widgets.screenshot.transparent);
  }
  say_if_replaced(context, widgets.screenshot.name);
  ImGui::Spacing();
  const bool go = ImGui::Button("Save");
  context.items.record_last("screenshot:go");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) context.state.dialog = Dialog::None;
  context.items.record_last("dialog:close");
  if ((go || entered) && !widgets.screenshot.name.empty()) {
    context.state.dialog = Dialog::None;
    std::string line = fmt::format("screenshot {}", quote_word(widgets.screenshot.name));
    if (widgets.screenshot.window) {
      line += " --window";
    } else {
      line += fmt::format(" --size {}x{} --supersample {}", widgets.screenshot.width, widgets.screenshot.height,
                          widgets.screenshot.supersample);
      if (widgets.screenshot.transparent) line += " --transparent";
    }
    context.send(line);
  }
  end_dialog();
}

}  // namespace dmoscope::ui
