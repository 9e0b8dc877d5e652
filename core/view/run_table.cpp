#include "core/view/run_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "core/base/csv_text.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/view/view.h"

namespace dmoscope {

namespace {

constexpr std::array<RunColumn, 17> kColumns{{
    {"run", "run", "the run", &RunRow::title},
    {"method", "method", "what smooths", &RunRow::method},
    {"metric", "metric", "the metric that the run optimises", &RunRow::metric},
    {"backend", "backend", "what it runs on", &RunRow::backend},
    {"judged_by", "judged by", "the metric that all qualities in the row are of", &RunRow::judged},
    {"iterations", "iterations", "whole iterations done", &RunRow::iterations, true},
    {"min_quality", "minimum", "the worst element", &RunRow::minimum},
    {"movable_minimum", "movable minimum", "the worst element with a corner that may move", &RunRow::movable_minimum},
    {"mean_quality", "mean", "of all elements", &RunRow::mean},
    {"p1", "1 %", "a hundredth of the elements is not better than this", &RunRow::p1},
    {"p5", "5 %", "a twentieth of the elements is not better than this", &RunRow::p5},
    {"inverted", "inverted", "elements with a corner Jacobian of 0 or less", &RunRow::inverted, true},
    {"seconds", "seconds", "of smoothing alone", &RunRow::seconds},
    {"vertices_per_second", "vertices/s", "free vertices times iterations in a second of smoothing; dmo passes over those at rest",
     &RunRow::vertices_per_second},
    {"input_size_correlation", "input's size corr.",
     "at the input: correlation of local edge length and target size, of runs that have one", &RunRow::input_size_correlation},
    {"size_correlation", "size corr.", "correlation of local edge length and target size, of runs that have one: 1 when they go together",
     &RunRow::size_correlation},
    {"mesh", "mesh", "the mesh that the run is on, where several are open", &RunRow::mesh},
}};

/// Whether a cell has a value to sort by.
bool has_value(const std::variant<std::string_view, double>& cell) {
  if (const auto* word = std::get_if<std::string_view>(&cell)) return !word->empty();
  return std::isfinite(std::get<double>(cell));
}

void judge(RunRow& row, const Statistics& statistics) {
  row.minimum = statistics.minimum;
  row.movable_minimum = statistics.movable_minimum;
  row.mean = statistics.mean;
  row.inverted = statistics.inverted;
}

void judge(RunRow& row, const SizeCourse& sizes) {
  row.input_size_correlation = sizes.before.sizes;
  row.size_correlation = sizes.after.sizes;
}

void judge(RunRow& row, const Percentiles& percentiles) {
  row.p1 = percentiles.p1;
  row.p5 = percentiles.p5;
}

/// Begins a row with the data that live and published runs have in common.
RunRow begin_row(const RunParameters& parameters, Metric judged, std::uint64_t iterations, std::span<const IterationRecord> records,
                 std::uint64_t visits_per_iteration) {
  RunRow row;
  row.method = parameters.method;
  row.metric = info(parameters.metric).name;
  row.judged = info(judged).name;
  row.iterations = iterations;
  for (std::uint64_t i = 1; i <= iterations && i < records.size(); ++i) row.seconds += records[i].seconds;
  if (row.seconds > 0.0) row.vertices_per_second = static_cast<double>(iterations * visits_per_iteration) / row.seconds;
  return row;
}

}  // namespace

RunRow row_of(const Run& run, Metric judged, ThreadPool* pool) {
  require_defined(judged, run.input());
  const QualityContext context = run.input().quality_context();
  const auto positions = run.positions();
  RunRow row = begin_row(run.parameters(), judged, run.moment().iteration, run.history().records(), run.visits_per_iteration());
  row.title = run.title();
  row.backend = name(run.backend());
  const bool own = judged == run.parameters().metric;
  judge(row, own ? run.statistics() : compute_statistics(context, positions, judged, run.immovable(), pool));
  judge(row, compute_percentiles(context, positions, judged, pool));
  judge(row, size_course_of(run));
  return row;
}

RunRow row_of_input(Metric judged, const Statistics& statistics, const Percentiles& percentiles) {
  RunRow row;
  row.title = "input";
  row.judged = info(judged).name;
  row.seconds = RunRow::kUnknown;
  judge(row, statistics);
  judge(row, percentiles);
  return row;
}

RunRow row_of(const RunView& run, Metric judged) {
  const std::span<const IterationRecord> records(run.records.data(), run.records.size());
  RunRow row = begin_row(run.parameters, judged, run.moment.iteration, records, run.visits_per_iteration);
  row.title = run.title;
  row.backend = name(run.backend);
  if (run.summary && run.summary->metric == judged) {
    judge(row, run.summary->statistics);
    judge(row, percentiles_of_sorted(run.summary->sorted));
    judge(row, run.summary->sizes);
  } else if (run.parameters.metric == judged && row.iterations < records.size()) {
    judge(row, records[row.iterations].statistics);
    if (row.iterations < run.percentiles.size()) judge(row, run.percentiles[row.iterations]);
  }
  return row;
}

std::span<const RunColumn> run_columns() { return kColumns; }

const RunColumn& run_column(std::string_view name) {
  const auto found = std::ranges::find(kColumns, name, &RunColumn::name);
  if (found != kColumns.end()) return *found;
  std::string known;
  for (const RunColumn& column : kColumns) known += fmt::format("{}{}", known.empty() ? "" : ", ", column.name);
  throw UsageError(fmt::format("unknown column '{}'; known are {}", name, known));
}

std::variant<std::string_view, double> cell(const RunRow& row, const RunColumn& column) {
  using Cell = std::variant<std::string_view, double>;
  return std::visit(
      [&row](const auto member) -> Cell {
        const auto& value = row.*member;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::string>) {
          return std::string_view(value);
        } else {
          return static_cast<double>(value);
        }
      },
      column.value);
}

std::string cell_text(const RunRow& row, const RunColumn& column) {
  const auto content = cell(row, column);
  if (const auto* word = std::get_if<std::string_view>(&content)) return std::string(*word);
  const double number = std::get<double>(content);
  if (!std::isfinite(number)) return "-";
  if (column.is_count) return grouped(static_cast<std::uint64_t>(number));
  if (column.name == "vertices_per_second") return with_prefix(number);
  return four_digits(number);
}

bool has_values(std::span<const RunRow> rows, const RunColumn& column) {
  return std::ranges::any_of(rows, [&](const RunRow& row) { return has_value(cell(row, column)); });
}

void sort_rows(std::span<RunRow> rows, const RunColumn& by, bool descending) {
  std::stable_sort(rows.begin(), rows.end(), [&](const RunRow& a, const RunRow& b) {
    const auto first = cell(a, by), second = cell(b, by);
    if (has_value(first) != has_value(second)) return has_value(first);
    if (!has_value(first)) return false;
    return descending ? second < first : first < second;
  });
}

std::string run_table_csv(std::span<const RunRow> rows) {
  std::string text;
  for (const RunColumn& column : kColumns) text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
  text += '\n';
  for (const RunRow& row : rows) {
    for (const RunColumn& column : kColumns) {
      if (&column != &kColumns.front()) text += ',';
      const auto content = cell(row, column);
      if (const auto* word = std::get_if<std::string_view>(&content)) {
        text += csv_text(*word);
      } else if (has_value(content)) {
        text += fmt::format("{}", std::get<double>(content));
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace dmoscope
