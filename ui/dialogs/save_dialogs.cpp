// Dialogs for export of the mesh and its numbers, of a plot, and of pictures: one, or one for each iteration.
#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/commands/commands.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"
#include "core/session/read_files.h"
#include "ui/dialogs/save_rows.h"
#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommands[] = {"export", "stats", "elements"};

std::string default_name(const PanelContext& context, int what) {
  return what == 0 ? name_beside(context, "-smoothed", {}) : name_beside(context, what == 1 ? "-stats" : "-elements", ".csv");
}

/// Endings for a kind of export. Meshes are packed by gzip if the name says so.
SaveEndings endings_of(const PanelContext& context, int what) {
  if (what != 0) return {what == 1 ? "a table of statistics" : "a table of elements", {".csv"}};
  return {"a mesh", {mesh_extension(default_name(context, 0))}, true};
}

void draw_formats(PanelContext& context, std::string& name) {
  const FormatInfo* current = format_by_extension(mesh_extension(name));
  row_label(context, "format", 6);
  const bool open = ImGui::BeginCombo("##format", current == nullptr ? "by the file's name" : std::string(current->title).c_str());
  if (!open) context.items.record_last("export:format");
  if (open) {
    for (const FormatInfo& format : format_table()) {
      const std::string_view first = format.extensions.substr(0, format.extensions.find(' '));
      if (format_by_extension(first)->name != format.name)
        continue;  // it differs from another format only by content, and is written by the source that reads it
      const std::string label = fmt::format("{}   {}", format.title, format.extensions);
      if (ImGui::Selectable(label.c_str(), &format == current)) {
        const std::string extensions(format.extensions);
        if (fs::path(name).extension() == ".gz") name = fs::path(name).replace_extension().string();
        name = fs::path(name).replace_extension(extensions.substr(0, extensions.find(' '))).string();
      }
      note_item(context, fmt::format("export:{}", format.name), std::string(format.doc));
    }
    ImGui::EndCombo();
  }
  if (current != nullptr) dim_text(context, std::string(current->doc));
}

/// Whether the export would replace the file that the mesh was read from, by whatever name.
bool writes_over_input(const PanelContext& context) {
  const ExportDialog& dialog = context.widgets.exporting;
  const Frame* frame = context.frame();
  return dialog.what == 0 && frame != nullptr && same_file(dialog.save.target.path(), frame->input->path);
}

/// Draws the question whether to overwrite the input in place of the dialog's buttons.
void ask_over_input(PanelContext& context) {
  ExportDialog& dialog = context.widgets.exporting;
  const std::string copy = original_name(context.frame()->input->path, 1).filename().string();
  wrapped_text("This is the file that the mesh was read from. It will hold the smoothed mesh; its present contents are kept beside it as " +
                   copy + " (or under the next number).",
               context.palette.warning);
  ImGui::Spacing();
  const bool go = ImGui::Button("Write over it, keep a copy");
  context.items.record_last("export:over");
  ImGui::SameLine();
  if (ImGui::Button("Back")) dialog.over_input = false;
  context.items.record_last("export:back");
  if (!go) return;
  context.state.dialog = Dialog::None;
  context.send("export-over " + quote_word(dialog.save.target.path().string()));
}

/// Formats of the plot: the table of runs has only numbers, a comparison also a page.
SaveEndings plot_endings(const PanelContext& context) {
  if (context.state.plot == PlotTab::Compare) return {"a comparison", {".html", ".svg", ".png", ".csv"}};
  if (context.state.plot == PlotTab::Runs) return {"the table of runs", {".csv"}};
  return {"a plot", {".svg", ".png", ".csv"}};
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
  const int last = static_cast<int>(std::min<std::uint64_t>(context.last_iteration(), 1'000'000'000));
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

void draw_export_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Export", 44)) return;
  ExportDialog& dialog = context.widgets.exporting;
  if (context.widgets.dialog_opened) begin_save(context, dialog.save, default_name(context, dialog.what));
  if (context.widgets.dialog_opened) dialog.over_input = false;
  if (dialog.over_input) {
    ask_over_input(context);
    end_dialog();
    return;
  }
  constexpr const char* kWhat[] = {"mesh as it is now", "statistics of all runs", "quality of every element"};
  for (int k = 0; k < 3; ++k) {
    if (k > 0) {
      ImGui::SameLine(0, context.px(16));
      const float wanted = ImGui::CalcTextSize(kWhat[k]).x + ImGui::GetFrameHeight() + context.px(6);
      if (ImGui::GetContentRegionAvail().x < wanted) ImGui::NewLine();
    }
    if (ImGui::RadioButton(kWhat[k], dialog.what == k)) {
      dialog.what = k;
      dialog.save.target.name = default_name(context, k);
      dialog.save.target.asked.clear();
      dialog.save.target.trouble.clear();
    }
    context.items.record_last(fmt::format("export:{}", kCommands[k]));
  }
  const SaveForm form{dialog.save, endings_of(context, dialog.what), Dialog::Export, "export"};
  const bool entered = draw_save_rows(context, form);
  if (dialog.what == 0) draw_formats(context, dialog.save.target.name);
  if (draw_save_buttons(context, form, "Export", entered))
    context.send(fmt::format("{} {}", kCommands[dialog.what], quote_word(dialog.save.target.path().string())));
  // The mesh's own file has a question of its own.
  if (std::string& asked = dialog.save.target.asked; !asked.empty() && writes_over_input(context)) {
    dialog.over_input = true;
    asked.clear();
  }
  end_dialog();
}

void draw_save_session_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Save the session", 44)) return;
  SaveRows& rows = context.widgets.save_session.save;
  const std::string ending(kSessionExtension);
  if (context.widgets.dialog_opened) begin_save(context, rows, name_beside(context, {}, ending));
  dim_text(context,
           "The runs with their histories, their current iterations, and the view. The mesh itself is not in it: its file is read again.");
  ImGui::Spacing();
  const SaveForm form{rows, {"a session", {ending}}, Dialog::SaveSession, "session"};
  const bool entered = draw_save_rows(context, form);
  if (draw_save_buttons(context, form, "Save", entered)) context.send("save-session " + quote_word(rows.target.path().string()));
  end_dialog();
}

namespace {

void draw_picture_choices(PanelContext& context, ScreenshotDialog& dialog) {
  const auto label = [&](const char* text) { row_label(context, text, 8); };
  label("what");
  if (ImGui::RadioButton("the mesh", !dialog.window)) dialog.window = false;
  context.items.record_last("screenshot:mesh");
  ImGui::SameLine();
  if (ImGui::RadioButton("the whole window", dialog.window)) dialog.window = true;
  context.items.record_last("screenshot:window");
  if (dialog.window) return;
  int size[2] = {dialog.width, dialog.height};
  label("size, pixels");
  if (ImGui::InputInt2("##size", size)) {
    dialog.width = std::clamp(size[0], 1, 32768);
    dialog.height = std::clamp(size[1], 1, 32768);
  }
  label("supersample");
  ImGui::SliderInt("##supersample", &dialog.supersample, 1, 8, "%d", ImGuiSliderFlags_AlwaysClamp);
  note_item(context, "screenshot:supersample", "samples a pixel: smoother edges");
  label("background");
  ImGui::Checkbox("transparent", &dialog.transparent);
  context.items.record_last("screenshot:transparent");
}

std::string command_of(const ScreenshotDialog& dialog) {
  std::string line = fmt::format("screenshot {}", quote_word(dialog.save.target.path().string()));
  if (dialog.window) return line + " --window";
  line += fmt::format(" --size {}x{} --supersample {}", dialog.width, dialog.height, dialog.supersample);
  return dialog.transparent ? line + " --transparent" : line;
}

}  // namespace

void draw_screenshot_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Screenshot", 44)) return;
  ScreenshotDialog& dialog = context.widgets.screenshot;
  if (context.widgets.dialog_opened) {
    begin_save(context, dialog.save, name_beside(context, {}, ".png"));
    dialog.width = static_cast<int>(context.state.viewport.x);
    dialog.height = static_cast<int>(context.state.viewport.y);
  }
  const SaveForm form{dialog.save, {"a screenshot", {".png"}}, Dialog::Screenshot, "screenshot", 8};
  const bool entered = draw_save_rows(context, form);
  draw_picture_choices(context, dialog);
  if (draw_save_buttons(context, form, "Save", entered)) context.send(command_of(dialog));
  end_dialog();
}

void draw_plot_dialog(PanelContext& context) {
  const bool compares = context.state.plot == PlotTab::Compare;
  if (!begin_dialog(context, compares ? "Save the comparison" : "Save the plot", 44)) return;
  PlotDialog& dialog = context.widgets.plot_dialog;
  const auto label = [&](const char* text) { row_label(context, text, 8); };
  const SaveForm form{dialog.save, plot_endings(context), Dialog::Plot, "plot", 8};
  if (context.widgets.dialog_opened)
    begin_save(context, dialog.save, name_beside(context, compares ? "-compared" : "-plot", form.endings.endings.front()));
  const bool entered = draw_save_rows(context, form);
  std::string& name = dialog.save.target.name;
  label("as");
  const std::string extension = std::filesystem::path(name).extension().string();
  static constexpr std::array<std::pair<const char*, const char*>, 4> kKinds{
      {{".html", "report (HTML)"}, {".svg", "drawing (SVG)"}, {".png", "picture (PNG)"}, {".csv", "numbers (CSV)"}}};
  for (const auto& [kind, title] : kKinds) {
    if (!compares && kind == kKinds[0].first) continue;
    if (kind != kKinds[compares ? 0 : 1].first) beside_or_below(title, context.px(16));
    if (ImGui::RadioButton(title, extension == kind)) name = std::filesystem::path(name).replace_extension(kind).string();
    context.items.record_last(fmt::format("plot:{}", kind + 1));
  }
  const bool is_drawn = extension != ".csv" && extension != ".html";
  if (is_drawn) {
    int size[2] = {dialog.width, dialog.height};
    label("size");
    if (ImGui::InputInt2("##size", size)) {
      dialog.width = std::clamp(size[0], 200, 4096);
      dialog.height = std::clamp(size[1], 120, 4096);
    }
    next_item_tooltip("width and height in pixels; text is 12 high");
  }
  if (extension == ".png") {
    label("pixels");
    ImGui::SliderInt("##scale", &dialog.scale, 1, 4,
                     fmt::format("{} x {}", dialog.width * dialog.scale, dialog.height * dialog.scale).c_str(),
                     ImGuiSliderFlags_AlwaysClamp);
  }
  dim_text(context, extension == ".html"
                        ? "One HTML page with the table, the courses, sorted qualities, the effect of each run on the mesh, and pictures, "
                          "as dmoscope compare --report writes it."
                        : "The plot as it is shown: tab, ranges, axes and visible curves. Pictures have a white background.");
  if (draw_save_buttons(context, form, "Save", entered)) {
    std::string line =
        fmt::format("{} {}", extension == ".html" ? "save-report" : "plot-save", quote_word(dialog.save.target.path().string()));
    const int scale = extension == ".png" ? dialog.scale : 1;
    if (is_drawn) line += fmt::format(" --size {}x{}", dialog.width * scale, dialog.height * scale);
    if (extension == ".png") line += fmt::format(" --scale {}", scale);
    context.send(line);
  }
  end_dialog();
}

void draw_sequence_dialog(PanelContext& context) {
  if (!begin_dialog(context, "Pictures of a run", 40)) return;
  SequenceDialog& widgets = context.widgets.sequence;
  if (context.widgets.dialog_opened) {
    widgets.from = 0;
    widgets.to = static_cast<int>(std::min<std::uint64_t>(context.last_iteration(), 1'000'000'000));
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
