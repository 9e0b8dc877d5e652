#pragma once
// How good cells are.

#include <cstddef>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"

namespace dmo {

struct Metric {
  std::string name;      // "mean-ratio": what others are called by
  std::string title;     // "Mean ratio"
  double lowest = 0.0;   // range; 1 is the ideal cell, 0 or less one that is inverted
  double highest = 1.0;  // likewise
  std::string formula;   // plain text
  std::string doc;       // a line: what it measures, and whose it is
};
/// All that there are.
[[nodiscard]] DMO_API std::vector<Metric> metrics();

/// Of every cell, mesh.cell_count() of them: 1 is ideal, 0 or less inverted; NaN where the metric is not defined for the kind. `threads`:
/// 0 for all processors; the values do not depend on it. Throws UsageError for an unknown metric.
[[nodiscard]] DMO_API std::vector<double> quality(const Mesh& mesh, const std::string& metric = "mean-ratio", unsigned threads = 0);

/// Of all cells at once.
struct Statistics {
  double minimum = 0.0;
  double mean = 0.0;
  double movable_minimum = 0.0;  // over cells with a corner off the boundary; infinite where there is none
  std::size_t inverted = 0;      // cells with a corner that is turned over, whatever the metric
  std::size_t worst_cell = 0;    // the first of those at the minimum
};
/// Throws UsageError for an unknown metric, or one that is not defined for all cells.
[[nodiscard]] DMO_API Statistics statistics(const Mesh& mesh, const std::string& metric = "mean-ratio", unsigned threads = 0);

}  // namespace dmo
