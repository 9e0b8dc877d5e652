// Dialog that saves the plot, or the comparison.
#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/dialogs/save_rows.h"
#include "ui/panels/widgets.h"

namespace dmoscope::ui {

namespace {

/// Formats of the plot: the table of runs has only numbers, a comparison also a page.
SaveEndings plot_endings(const PanelContext& context) {
  if (context.state.plot == PlotTab::Compare) return {"a comparison", {".html", ".svg", ".png", ".csv"}};
  if (context.state.plot == PlotTab::Runs) return {"the table of runs", {".csv"}};
  return {"a plot", {".svg", ".png", ".csv"}};
}

}  // namespace

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

}  // namespace dmoscope::ui
