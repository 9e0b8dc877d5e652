#pragma once
// Table for the comparison of runs: one row for each run, all judged by one metric.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/run/run.h"

namespace dmoscope {

struct RunView;

/// Figures of a run at its present moment. Unknown values are NaN.
struct RunRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::size_t run = 0;                         // index of the run, from 0, if the caller has set it
  std::string title, method, metric, backend;  // metric: the one the run optimises
  std::string judged;                          // metric of the qualities below
  std::string mesh;                            // name of the mesh, if the caller has set it: with several meshes
  std::uint64_t iterations = 0;                // whole iterations up to the run's moment
  double minimum = kUnknown, movable_minimum = kUnknown, mean = kUnknown;
  double p1 = kUnknown, p5 = kUnknown;  // see Percentiles
  double inverted = kUnknown;           // number of inverted elements
  double seconds = 0.0;                 // seconds of smoothing in those iterations
  double vertices_per_second = kUnknown;
  double input_size_correlation = kUnknown, size_correlation = kUnknown;  // see SizeCourse
};

/// Row of the mesh as it was read.
[[nodiscard]] RunRow row_of_input(Metric judged, const Statistics& statistics, const Percentiles& percentiles);

/// Row of a run in its present state. Throws UsageError if the metric is not defined for the mesh, DeviceError (see Run::recover).
[[nodiscard]] RunRow row_of(const Run& run, Metric judged, ThreadPool* pool);

/// Row of a published run. Without a summary by `judged`, figures come from the records if the run optimises that metric. The percentiles
/// are those of the summary's choice of elements (Summaries::kMostSorted), in float.
[[nodiscard]] RunRow row_of(const RunView& run, Metric judged);

/// A column of the table.
struct RunColumn {
  std::string_view name;   // name in a CSV: "min_quality"
  std::string_view title;  // title for people: "minimum"
  std::string_view doc;    // description in one line
  std::variant<std::string RunRow::*, std::uint64_t RunRow::*, double RunRow::*> value;
  bool is_count = false;
  [[nodiscard]] bool is_word() const noexcept { return value.index() == 0; }
};
[[nodiscard]] std::span<const RunColumn> run_columns();
/// The column with this name in a CSV. Throws UsageError that lists the known names.
[[nodiscard]] const RunColumn& run_column(std::string_view name);

/// Content of a cell: a word, or a number, which may be NaN (not known) or infinite (does not exist). Words are views of the row.
[[nodiscard]] std::variant<std::string_view, double> cell(const RunRow& row, const RunColumn& column);
/// Text of a cell for people: four significant digits, counts in full ("1,234"), speeds in three digits and a prefix ("11.4 M"); "-" if it
/// is not known or does not exist.
[[nodiscard]] std::string cell_text(const RunRow& row, const RunColumn& column);

/// Whether any of the rows has a value in a column.
[[nodiscard]] bool has_values(std::span<const RunRow> rows, const RunColumn& column);

/// Sorts rows by a column. Rows of equal value keep their order; those without a value come last in either direction.
void sort_rows(std::span<RunRow> rows, const RunColumn& by, bool descending);

/// Table with one line for each row below the names of all columns. Numbers are the shortest that read back as the same double; values that
/// are not known or do not exist are empty; words are quoted if necessary.
[[nodiscard]] std::string run_table_csv(std::span<const RunRow> rows);

}  // namespace dmoscope
