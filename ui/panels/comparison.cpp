// Below the viewports: runs side by side, as curves that one metric judges and as a matrix of all.
#include "ui/analysis/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/words.h"
#include "ui/panels/plot_parts.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

constexpr std::array<std::pair<const char*, const char*>, Comparison::kMeasures> kMeasureTitles{
    {{"Worst", "the worst element"}, {"1 %", "1 % of the elements are no better than this"}, {"Mean", "of all elements"}}};

void judge_by(PanelContext& context, Metric metric) {
  context.send("judged-by shown");
  context.send("show " + quote_word(info(metric).name));
}

/// Draws the choice of the metric that judges the curves: buttons for a few, a list for more.
void draw_judges(PanelContext& context, const Comparison& comparison) {
  constexpr std::size_t kMostButtons = 3;
  constexpr const char* kTooltip = "judges all runs by this metric, and colours the meshes by it";
  const bool own = context.state.plot_options.judged_own, few = comparison.metrics.size() <= kMostButtons;
  ImGui::AlignTextToFramePadding();
  dim_text(context, "Judged by", false);
  for (const Metric metric : comparison.metrics) {
    if (!few) break;
    ImGui::SameLine(0, context.px(6));
    const bool on = !own && metric == context.session.shown;
    if (lit_button(context, fmt::format("judge:{}", info(metric).name), metric_title(metric), on, kTooltip)) judge_by(context, metric);
  }
  ImGui::SameLine(0, context.px(6));
  if (!few) {
    ImGui::SetNextItemWidth(std::min(12 * context.em(), ImGui::GetContentRegionAvail().x - widest_button({"Its own"}) - context.px(8)));
    if (Combo combo(context, "judge", own ? std::string("each its own") : metric_title(context.session.shown)); combo.open())
      for (const Metric metric : comparison.metrics)
        if (combo.entry(info(metric).name, metric_title(metric), !own && metric == context.session.shown, kTooltip))
          judge_by(context, metric);
    ImGui::SameLine(0, context.px(6));
  }
  if (lit_button(context, "judge:own", "Its own", own, "each run by the metric that it optimises")) context.send("judged-by own");
}

void right_text(const std::string& text, const render::Rgb& ink) {
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x));
  ImGui::TextColored(colour_vector(ink), "%s", text.c_str());
}

/// Draws the name of a metric above its first column, over those of the others.
void draw_metric_names(PanelContext& context, const Comparison& comparison) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  for (const Metric metric : comparison.metrics)
    for (std::size_t k = 0; k < Comparison::kMeasures; ++k) {
      ImGui::TableNextColumn();
      if (k != 0) continue;
      const std::string name = "by " + metric_phrase(metric);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const float cell = ImGui::GetContentRegionAvail().x + 2 * ImGui::GetStyle().CellPadding.x;
      const float room = cell * Comparison::kMeasures - 2 * ImGui::GetStyle().CellPadding.x;
      const std::string text = fit_text(name, room);
      ImDrawList& list = *ImGui::GetWindowDrawList();
      list.PushClipRect({at.x, at.y}, {at.x + room, at.y + ImGui::GetTextLineHeight() + 2}, false);
      list.AddText({at.x + std::max(0.0F, room - ImGui::CalcTextSize(text.c_str()).x), at.y}, colour(context.palette.text), text.c_str());
      list.PopClipRect();
      ImGui::Dummy({1, ImGui::GetTextLineHeight()});
      metric_tooltip(context, info(metric));
    }
}

void draw_head(PanelContext& context, const Comparison& comparison) {
  draw_metric_names(context, comparison);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  dim_text(context, "Run", false);
  for (std::size_t m = 0; m < comparison.metrics.size(); ++m)
    for (const auto& [title, tooltip] : kMeasureTitles) {
      ImGui::TableNextColumn();
      right_text(title, context.palette.dim);
      next_item_tooltip(tooltip);
    }
}

/// Title of a run's row, without the method if all runs have the same one.
std::string title_of_row(const PanelContext& context, std::size_t run) {
  const RunName name = run_name(context.session, run);
  return context.shown(name.one_method && !name.rest.empty() ? name.number + " " + name.rest : name.whole());
}

void draw_title(PanelContext& context, const Comparison::Row& row) {
  if (row.run == Comparison::kInput) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + context.px(10));
    return dim_text(context, "Input", false);
  }
  draw_run_cell(context, row.run, fmt::format("compared:{}", row.run + 1), title_of_row(context, row.run));
}

void draw_row(PanelContext& context, const Comparison::Row& row) {
  ImGui::TableNextRow();
  ImGui::PushID(static_cast<int>(row.run));
  ImGui::TableNextColumn();
  draw_title(context, row);
  for (const Comparison::Cell& cell : row.cells) {
    ImGui::TableNextColumn();
    if (cell.best) ImGui::PushFont(context.fonts.bold);
    right_text(std::isfinite(cell.value) ? short_number(cell.value) : "–",
               cell.best || row.run == context.session.active ? context.palette.text : context.palette.dim);
    if (cell.best) ImGui::PopFont();
    if (std::isfinite(cell.value)) next_item_tooltip(full_number(cell.value) + (cell.best ? "\nthe best of its column" : ""));
  }
  ImGui::PopID();
}

void draw_matrix(PanelContext& context, const Comparison& comparison) {
  const int columns = static_cast<int>(1 + comparison.metrics.size() * Comparison::kMeasures);
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedFit;
  const float buttons = ImGui::GetFrameHeightWithSpacing(), room = ImGui::GetContentRegionAvail().x;
  if (!ImGui::BeginTable("comparison", columns, kFlags, {0, std::max(4 * context.em(), ImGui::GetContentRegionAvail().y - buttons)}))
    return;
  ImGui::PushFont(context.fonts.bold);
  float number = ImGui::CalcTextSize("0.0000").x;
  for (const Comparison::Row& row : comparison.rows)
    for (const Comparison::Cell& cell : row.cells) number = std::max(number, ImGui::CalcTextSize(short_number(cell.value).c_str()).x);
  ImGui::PopFont();
  const float around = 2 * ImGui::GetStyle().CellPadding.x, bar = ImGui::GetStyle().ScrollbarSize;
  float widest = 6 * context.em();
  for (std::size_t k = 0; k < context.session.runs.size(); ++k)
    widest = std::max(widest, ImGui::CalcTextSize(title_of_row(context, k).c_str()).x + 1.2F * context.em());
  const float rest = room - bar - static_cast<float>(columns - 1) * (number + around) - around;
  ImGui::TableSetupColumn("run", ImGuiTableColumnFlags_WidthFixed, std::clamp(rest, 6 * context.em(), widest));
  for (int k = 1; k < columns; ++k) ImGui::TableSetupColumn(std::to_string(k).c_str(), ImGuiTableColumnFlags_WidthFixed, number);
  ImGui::TableSetupScrollFreeze(1, 2);
  draw_head(context, comparison);
  for (const Comparison::Row& row : comparison.rows) draw_row(context, row);
  ImGui::EndTable();
}

void draw_buttons(PanelContext& context, const Comparison& comparison) {
  const std::size_t active = context.session.active, other = active == 0 ? 1 : 0;
  const bool shown = context.state.colouring.by == ColourBy::Difference;
  if (ImGui::Button(shown ? "Show quality" : "Show the difference", {widest_button({"Show the difference"}), 0})) {
    context.send(shown ? std::string("color-by quality") : fmt::format("color-by difference run {}", other + 1));
  }
  note_item(context, "compare-difference",
            fmt::format("colours each element of the active run by its quality less that of run {}, by the shown metric", other + 1));
  ImGui::SameLine();
  action_button(context, "plot-save", "Save report…");
  ImGui::SameLine();
  action_button(context, "compare-runs", "Compare…");
  if (comparison.remark.empty()) return;
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(comparison.remark.c_str()).x) return ImGui::NewLine();
  ImGui::AlignTextToFramePadding();
  dim_text(context, comparison.remark, false);
}

}  // namespace

void draw_comparison(PanelContext& context) {
  const Comparison comparison = compare_runs(context.session);
  if (comparison.rows.empty()) {
    dim_text(context, "Runs are compared here by every metric that one of them optimises. There is only one run so far.");
    action_button(context, "compare-runs", "Compare…");
    return;
  }
  const float room = ImGui::GetContentRegionAvail().x;
  const bool both = room > 48 * context.em();
  if (both) {
    ImGui::BeginChild("judged curves", {std::floor(0.37F * room), 0}, false,
                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_judges(context, comparison);
    draw_plot_area(context);
    ImGui::EndChild();
    ImGui::SameLine(0, context.px(16));
  }
  ImGui::BeginChild("matrix", {0, 0}, false, ImGuiWindowFlags_NoScrollbar);
  if (!both) draw_judges(context, comparison);
  draw_matrix(context, comparison);
  draw_buttons(context, comparison);
  ImGui::EndChild();
}

}  // namespace dmoscope::ui
