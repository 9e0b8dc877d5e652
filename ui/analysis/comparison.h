#pragma once
// Runs and measures as a matrix: every run by every metric that a run optimises.

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Worst element, worst 1 per cent and mean by each metric.
struct Comparison {
  static constexpr std::size_t kMeasures = 3;
  struct Cell {
    double value = std::numeric_limits<double>::quiet_NaN();  // NaN: not known, or the metric is not defined for the run's mesh
    bool best = false;                                        // best of all runs in its column; all that look equal, but none if all do
  };
  struct Row {
    std::size_t run = kInput;
    std::vector<Cell> cells;  // kMeasures per metric
  };
  static constexpr std::size_t kInput = static_cast<std::size_t>(-1);
  std::vector<Metric> metrics;
  std::vector<Row> rows;  // the input of the active run's mesh first
  /// "Each metric wins by its own measure." if so; else empty.
  std::string remark;
};

/// Comparison of all runs; empty while there is only one.
[[nodiscard]] Comparison compare_runs(const SessionView& session);

/// The comparison as CSV: a line of names, then one a row; numbers are the shortest that read back as the same double, unknown ones are
/// empty.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison, const SessionView& session);

/// Values of a run by a metric; null: not known.
[[nodiscard]] const JudgedBy* judged_by(const RunView& run, Metric metric);

}  // namespace dmoscope::ui
