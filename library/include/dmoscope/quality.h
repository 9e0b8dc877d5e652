#pragma once
// Quality of cells.

#include <cstddef>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"

namespace dmo {

struct Metric {
  std::string name;      // name to pass to functions: "mean-ratio"
  std::string title;     // title for people: "Mean ratio"
  double lowest = 0.0;   // least value; 0 or less means inverted
  double highest = 1.0;  // greatest value; 1 is the ideal cell
  std::string formula;   // plain text
  std::string doc;       // one line: its meaning and its source
};
/// Returns all built-in metrics.
[[nodiscard]] DMO_API std::vector<Metric> metrics();

/// Returns the quality of every cell, mesh.cell_count() values: 1 is ideal, 0 or less inverted; NaN if the metric is not defined for the
/// kind. `threads`: 0 for all processors; the values do not depend on it. Throws UsageError for an unknown metric.
[[nodiscard]] DMO_API std::vector<double> quality(const Mesh& mesh, const std::string& metric = "mean-ratio", unsigned threads = 0);

/// Statistics of the quality of all cells.
struct Statistics {
  double minimum = 0.0;
  double mean = 0.0;
  double movable_minimum = 0.0;  // over cells with a corner off the boundary; infinite if there is none
  std::size_t inverted = 0;      // cells whose Jacobian is not positive at some corner, by any metric
  std::size_t worst_cell = 0;    // the first cell at the minimum
};
/// Returns the statistics of all cells. Throws UsageError for an unknown metric, or one that is not defined for all cells.
[[nodiscard]] DMO_API Statistics statistics(const Mesh& mesh, const std::string& metric = "mean-ratio", unsigned threads = 0);

}  // namespace dmo
