#pragma once
// Runs side by side as a table: a row a run, all judged by one metric.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/run/run.h"

namespace dmoscope {

struct RunView;

/// How a run fares where it stands. Values that are not known are NaN.
struct RunRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::size_t run = 0;                         // its place among the runs, from 0, where whoever made the row has set it
  std::string title, method, metric, backend;  // metric: the one the run optimises
  std::string judged;                          // the metric that the qualities below are of
  std::string mesh;                            // its name, where whoever made the row has set it: of several meshes
  std::uint64_t iterations = 0;                // whole ones, up to where the run stands
  double minimum = kUnknown, movable_minimum = kUnknown, mean = kUnknown;
  double p1 = kUnknown, p5 = kUnknown;  // see Percentiles
  double inverted = kUnknown;           // elements
  double seconds = 0.0;                 // of smoothing, in those iterations
  double vertices_per_second = kUnknown;
  double input_size_correlation = kUnknown, size_correlation = kUnknown;  // see SizeCourse
};

/// The mesh as it was read, as a row beside the runs.
[[nodiscard]] RunRow row_of_input(Metric judged, const Statistics& statistics, const Percentiles& percentiles);

/// Of a run as it stands. Throws UsageError when the metric is not defined for the mesh, DeviceError (see Run::recover).
[[nodiscard]] RunRow row_of(const Run& run, Metric judged, ThreadPool* pool);

/// Of a run as it was published. While there is no summary by `judged`, the records say what they can where the run optimises that metric.
/// The percentiles are those of the summary's choice of elements (Summaries::kMostSorted), in float.
[[nodiscard]] RunRow row_of(const RunView& run, Metric judged);

/// A column of the table.
struct RunColumn {
  std::string_view name;   // in a CSV: "min_quality"
  std::string_view title;  // for a person: "minimum"
  std::string_view doc;    // one line
  std::variant<std::string RunRow::*, std::uint64_t RunRow::*, double RunRow::*> value;
  bool is_count = false;
  [[nodiscard]] bool is_word() const noexcept { return value.index() == 0; }
};
[[nodiscard]] std::span<const RunColumn> run_columns();
/// By its name in a CSV. Throws UsageError that lists the known names.
[[nodiscard]] const RunColumn& run_column(std::string_view name);

/// What stands in a cell: a word, or a number, which may be NaN (not known) or infinite (there is nothing to take it of). Words lie in the
/// row.
[[nodiscard]] std::variant<std::string_view, double> cell(const RunRow& row, const RunColumn& column);
/// The same for a person: four significant digits, counts in full ("1,234"), speeds in three digits and a prefix ("11.4 M"); "-" for what
/// is not known or does not exist.
[[nodiscard]] std::string cell_text(const RunRow& row, const RunColumn& column);

/// Whether any of the rows has a value there: a column that is empty for all says nothing.
[[nodiscard]] bool has_values(std::span<const RunRow> rows, const RunColumn& column);

/// Rows with the same value keep their order; those without a value come last, whichever way.
void sort_rows(std::span<RunRow> rows, const RunColumn& by, bool descending);

/// A line a row below the names of all columns. Numbers are the shortest that read back as the same double; what is not known or does not
/// exist is empty; words are quoted where they must be.
[[nodiscard]] std::string run_table_csv(std::span<const RunRow> rows);

}  // namespace dmoscope
