// Bottom: the table of runs.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/plot_parts.h"
#include "ui/plots/run_rows.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr std::string_view kSizes = "size_correlation";  // shares a column with the input's

constexpr const char* kMesh = "mesh";  // shown for several meshes

struct ShownColumn {
  const char* column;
  const char* title;   // short, because many stand side by side
  bool large_is_best;  // marks the largest as the best
};
constexpr std::array<ShownColumn, 13> kColumns{{{"run", "run", false},
                                                {kMesh, "mesh", false},
                                                {"iterations", "iterations", false},
                                                {"min_quality", "minimum", true},
                                                {"movable_minimum", "movable", true},
                                                {"mean_quality", "mean", true},
                                                {"p1", "1 %", true},
                                                {"p5", "5 %", true},
                                                {"inverted", "inverted", false},
                                                {"size_correlation", "size corr.", true},
                                                {"seconds", "seconds", false},
                                                {"vertices_per_second", "vertices/s", false},
                                                {"backend", "backend", false}}};

/// Columns to be shown: that of sizes only if a run has a size function, that of meshes only if there are several.
std::vector<ShownColumn> shown_columns(const std::vector<RunRow>& rows) {
  std::vector<ShownColumn> shown(kColumns.begin(), kColumns.end());
  if (!has_values(rows, run_column(kSizes))) std::erase_if(shown, [](const ShownColumn& one) { return one.column == kSizes; });
  if (!has_values(rows, run_column(kMesh))) std::erase_if(shown, [](const ShownColumn& one) { return one.column == kMesh; });
  return shown;
}

/// Next order of a column: ascending, then descending, then by making; numbers begin with the largest.
std::string next_sort(const PlotOptions& options, const RunColumn& column) {
  const bool first_way = !column.is_word();
  if (options.sorted_by != column.name) return fmt::format("sort-runs {} {}", column.name, first_way ? "descending" : "ascending");
  if (options.descending == first_way) return fmt::format("sort-runs {} {}", column.name, first_way ? "ascending" : "descending");
  return "sort-runs off";
}

void draw_head(PanelContext& context, const std::vector<ShownColumn>& columns) {
  const PlotOptions& options = context.state.plot_options;
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (const ShownColumn& shown : columns) {
    const RunColumn& column = run_column(shown.column);
    ImGui::TableNextColumn();
    const bool sorted = options.sorted_by == column.name;
    const std::string text = fmt::format("{}{}", shown.title, !sorted ? "" : options.descending ? " ▼" : " ▲");
    const float width = ImGui::GetContentRegionAvail().x, left = ImGui::GetCursorPosX();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable(fmt::format("##{}", column.name).c_str(), false)) context.send(next_sort(options, column));
    note_item(context, fmt::format("run-table:{}", column.name), fmt::format("{}: {}\nclick to sort", column.title, column.doc));
    const float shift = column.is_word() ? 0.0F : std::max(0.0F, width - ImGui::CalcTextSize(text.c_str()).x);
    ImGui::GetWindowDrawList()->AddText({at.x + shift, at.y}, colour(sorted ? context.palette.text : context.palette.dim), text.c_str());
    ImGui::SetCursorPosX(left);
  }
}

/// The largest value of a column among the rows; NaN unless there are two different ones.
double best_of(const std::vector<RunRow>& rows, const RunColumn& column) {
  double best = RunRow::kUnknown, least = RunRow::kUnknown;
  for (const RunRow& row : rows) {
    const double value = std::get<double>(cell(row, column));
    if (!std::isfinite(value)) continue;
    if (!(value <= best)) best = value;
    if (!(value >= least)) least = value;
  }
  return best > least ? best : RunRow::kUnknown;
}

void draw_number(PanelContext& context, const RunRow& row, const RunColumn& column, double best) {
  const double value = std::get<double>(cell(row, column));
  std::string text = cell_text(row, column);
  if (column.name == kSizes && std::isfinite(value)) text = size_course_text(row.input_size_correlation, value);
  const bool bad = column.name == "inverted" && value > 0.0;
  if (value == best) ImGui::PushFont(context.fonts.bold);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x));
  ImGui::TextColored(colour_vector(bad ? context.palette.error : context.palette.text), "%s", text.c_str());
  if (value == best) ImGui::PopFont();
  if (std::isfinite(value)) next_item_tooltip(full_number(value));
}

/// Draws the inputs' values above all runs, however these are sorted.
void draw_inputs(PanelContext& context, const std::vector<ShownColumn>& columns) {
  for (const RunRow& row : input_rows(context.session)) {
    ImGui::TableNextRow();
    for (const ShownColumn& shown : columns) {
      const RunColumn& column = run_column(shown.column);
      ImGui::TableNextColumn();
      if (&shown == &columns.front()) {
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + context.px(10));
        dim_text(context, row.title, false);
      } else if (column.is_word()) {
        dim_text(context, cell_text(row, column), false);
      } else {
        draw_number(context, row, column, RunRow::kUnknown);
      }
    }
  }
}

}  // namespace

void draw_run_cell(PanelContext& context, std::size_t run, const std::string& item, const std::string& title) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight(), inset = context.px(10), room = ImGui::GetContentRegionAvail().x - inset;
  const bool active = run == context.session.active;
  if (ImGui::Selectable("##row", active, ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap) && !active)
    context.send(fmt::format("select-run {}", run + 1));
  context.items.record_last(item);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x, at.y + 0.15F * line}, {at.x + context.px(4), at.y + 0.9F * line}, colour(context.palette.run(run)),
                     context.px(2));
  list.AddText({at.x + inset, at.y}, colour(context.palette.text), fit_text(title, room).c_str());
}

void draw_run_table(PanelContext& context) {
  if (context.session.runs.empty()) return dim_text(context, "no runs yet: open a mesh");
  const std::vector<RunRow> rows = sorted_runs(context.session, context.state.plot_options);
  const std::vector<ShownColumn> columns = shown_columns(rows);
  dim_text(context, fmt::format("judged by {}, the metric that is shown", metric_phrase(context.session.shown)), false);
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedFit;
  if (!ImGui::BeginTable("runs", static_cast<int>(columns.size()), kFlags)) return;
  float widest = 0, widest_mesh = 0;
  for (const RunRow& row : rows) {
    widest = std::max(widest, ImGui::CalcTextSize(row.title.c_str()).x);
    widest_mesh = std::max(widest_mesh, ImGui::CalcTextSize(row.mesh.c_str()).x);
  }
  for (const ShownColumn& shown : columns) {
    const bool title = &shown == &columns.front();
    ImGui::TableSetupColumn(shown.title, ImGuiTableColumnFlags_WidthFixed,
                            title                    ? widest + 2 * context.em()
                            : shown.column == kMesh  ? std::max(4 * context.em(), widest_mesh + context.em())
                            : shown.column == kSizes ? 7.5F * context.em()
                                                     : std::max(4.5F * context.em(), ImGui::CalcTextSize(shown.title).x + context.em()));
  }
  ImGui::TableSetupScrollFreeze(1, 1);
  draw_head(context, columns);
  std::vector<double> best(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    best[k] = columns[k].large_is_best ? best_of(rows, run_column(columns[k].column)) : RunRow::kUnknown;
  draw_inputs(context, columns);
  for (const RunRow& row : rows) {
    ImGui::TableNextRow();
    ImGui::PushID(static_cast<int>(row.run));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const RunColumn& column = run_column(columns[k].column);
      ImGui::TableNextColumn();
      if (k == 0) {
        draw_run_cell(context, row.run, fmt::format("run-row:{}", row.run + 1), row.title);
      } else if (column.is_word()) {
        dim_text(context, cell_text(row, column), false);
      } else {
        draw_number(context, row, column, best[k]);
      }
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
}

}  // namespace dmoscope::ui
