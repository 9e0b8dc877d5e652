// Tables of all runs: by the shown metric, and by every metric that one of them optimises.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/words.h"
#include "ui/analysis/comparison.h"
#include "ui/panels/panels.h"
#include "ui/plots/run_rows.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

constexpr ImGuiTableFlags kTableFlags =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedFit;

/// Draws the first cell of a run's row in a table: its colour and title, recorded as `item`; a click makes it the active run.
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
  right_text(text, bad ? context.palette.error : context.palette.text);
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

/// Width of the row of buttons that draw_judges() draws for a few metrics.
float judges_width(const PanelContext& context, const Comparison& comparison) {
  float width = ImGui::CalcTextSize("Judged by").x + widest_button({"Its own"}) + context.px(6);
  for (const Metric metric : comparison.metrics) width += widest_button({metric_title(metric).c_str()}) + context.px(6);
  return width;
}

/// Four significant digits of a quality, three of one below 0.01, so that all take about the same room.
std::string matrix_number(double value) { return value > 0.0 && value < 0.01 ? fmt::format("{:#.3g}", value) : short_number(value); }

/// Widths of the matrix's columns in pixels: those of the numbers; that of the widest name; and of all besides the name.
struct MatrixWidths {
  std::vector<float> numbers;
  float name = 0, rest = 0;
  MatrixWidths(const PanelContext& context, const Comparison& comparison)
      : numbers(comparison.metrics.size() * Comparison::kMeasures, ImGui::CalcTextSize("0.000").x), name(6 * context.em()) {
    for (const Comparison::Row& row : comparison.rows)
      for (std::size_t k = 0; k < row.cells.size(); ++k) {
        ImGui::PushFont(row.cells[k].best ? context.fonts.bold : context.fonts.body);
        numbers[k] = std::max(numbers[k], ImGui::CalcTextSize(matrix_number(row.cells[k].value).c_str()).x);
        ImGui::PopFont();
      }
    for (const RunName& run : run_names(context.session))
      name = std::max(name, ImGui::CalcTextSize(context.shown(run.brief()).c_str()).x + 1.2F * context.em());
    const float around = 2 * ImGui::GetStyle().CellPadding.x;
    rest =
        std::accumulate(numbers.begin(), numbers.end(), around * static_cast<float>(numbers.size() + 1)) + ImGui::GetStyle().ScrollbarSize;
  }
};

/// Draws the name of a metric above its first column, over those of the others, as far as the table's scrolled part reaches.
void draw_metric_names(PanelContext& context, const Comparison& comparison, const MatrixWidths& widths) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  float first = 0;
  const float last = ImGui::GetWindowPos().x + ImGui::GetWindowWidth(), padding = 2 * ImGui::GetStyle().CellPadding.x;
  for (std::size_t m = 0; m < comparison.metrics.size(); ++m) {
    ImGui::TableSetColumnIndex(static_cast<int>(1 + m * Comparison::kMeasures));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (m == 0) first = at.x + ImGui::GetScrollX();
    const auto column = widths.numbers.begin() + static_cast<std::ptrdiff_t>(m * Comparison::kMeasures);
    const float room = std::accumulate(column, column + Comparison::kMeasures, padding * (Comparison::kMeasures - 1));
    const std::string text = fit_text("by " + metric_phrase(comparison.metrics[m]), room);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({std::max(at.x, first), at.y}, {std::min(at.x + room, last), at.y + ImGui::GetTextLineHeight() + 2}, false);
    list.AddText({at.x + std::max(0.0F, room - ImGui::CalcTextSize(text.c_str()).x), at.y}, colour(context.palette.text), text.c_str());
    list.PopClipRect();
    ImGui::Dummy({1, ImGui::GetTextLineHeight()});
    metric_tooltip(context, info(comparison.metrics[m]));
  }
}

void draw_head(PanelContext& context, const Comparison& comparison, const MatrixWidths& widths) {
  draw_metric_names(context, comparison, widths);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  dim_text(context, "Run", false);
  for (std::size_t m = 0; m < comparison.metrics.size(); ++m)
    for (const auto& [title, tooltip] : kMeasureTitles) {
      ImGui::TableNextColumn();
      right_text(title, context.palette.dim);
      note_item(context, fmt::format("compared:{}:{}", info(comparison.metrics[m]).name, title), tooltip);
    }
}

void draw_title(PanelContext& context, const Comparison::Row& row) {
  if (row.run == Comparison::kInput) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + context.px(10));
    return dim_text(context, "Input", false);
  }
  draw_run_cell(context, row.run, fmt::format("compared:{}", row.run + 1), context.shown(run_name(context.session, row.run).brief()));
}

void draw_row(PanelContext& context, const Comparison::Row& row) {
  ImGui::TableNextRow();
  ImGui::PushID(static_cast<int>(row.run));
  ImGui::TableNextColumn();
  draw_title(context, row);
  for (const Comparison::Cell& cell : row.cells) {
    ImGui::TableNextColumn();
    if (cell.best) ImGui::PushFont(context.fonts.bold);
    right_text(matrix_number(cell.value), cell.best || row.run == context.session.active ? context.palette.text : context.palette.dim);
    if (cell.best) ImGui::PopFont();
    if (std::isfinite(cell.value)) next_item_tooltip(full_number(cell.value) + (cell.best ? "\nthe best of its column" : ""));
  }
  ImGui::PopID();
}

void draw_matrix(PanelContext& context, const Comparison& comparison, const MatrixWidths& widths) {
  const int columns = static_cast<int>(1 + comparison.metrics.size() * Comparison::kMeasures);
  const float buttons = ImGui::GetFrameHeightWithSpacing(), room = ImGui::GetContentRegionAvail().x;
  if (!ImGui::BeginTable("comparison", columns, kTableFlags, {0, std::max(4 * context.em(), ImGui::GetContentRegionAvail().y - buttons)}))
    return;
  // Numbers that have no room can be scrolled to; the names stay beside them.
  const float least = std::min(widths.name, 5.5F * context.em());
  ImGui::TableSetupColumn("run", ImGuiTableColumnFlags_WidthFixed, std::clamp(room - widths.rest, least, widths.name));
  for (const float width : widths.numbers) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, width);
  ImGui::TableSetupScrollFreeze(1, 2);
  draw_head(context, comparison, widths);
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

void draw_run_table(PanelContext& context) {
  if (context.session.runs.empty()) return dim_text(context, "no runs yet: open a mesh");
  const std::vector<RunRow> rows = sorted_runs(context.session, context.state.plot_options);
  const std::vector<ShownColumn> columns = shown_columns(rows);
  dim_text(context, fmt::format("judged by {}, the metric that is shown", metric_phrase(context.session.shown)), false);
  if (!ImGui::BeginTable("runs", static_cast<int>(columns.size()), kTableFlags)) return;
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

void draw_comparison(PanelContext& context) {
  const Comparison comparison = compare_runs(context.session);
  if (comparison.rows.empty()) {
    dim_text(context, "Runs are compared here by every metric that one of them optimises. There is only one run so far.");
    action_button(context, "compare-runs", "Compare…");
    return;
  }
  const float room = ImGui::GetContentRegionAvail().x;
  const bool both = room > 48 * context.em();
  const ImVec2 padding = ImGui::GetStyle().CellPadding;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {both ? padding.x : context.px(2), padding.y});
  const MatrixWidths widths(context, comparison);
  if (both) {
    const float between = context.px(16), most = std::max(0.37F * room, std::min(judges_width(context, comparison), 0.45F * room));
    const float least = std::min(most, judges_width(context, comparison)),
                curves = std::clamp(room - between - widths.name - widths.rest, least, most);
    ImGui::BeginChild("judged curves", {std::floor(curves), 0}, false,
                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_judges(context, comparison);
    draw_plot_area(context);
    ImGui::EndChild();
    ImGui::SameLine(0, between);
  }
  ImGui::BeginChild("matrix", {0, 0}, false, ImGuiWindowFlags_NoScrollbar);
  if (!both) draw_judges(context, comparison);
  draw_matrix(context, comparison, widths);
  draw_buttons(context, comparison);
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

}  // namespace dmoscope::ui
