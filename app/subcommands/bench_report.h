#pragma once
// Output of `dmoscope bench`: a table, one JSON object, a plot.

#include <vector>

#include "app/common/line_plot.h"
#include "app/common/text.h"
#include "app/subcommands/bench_measure.h"

namespace dmoscope::app {

/// Prints the conditions of the figures, and the head of the table; then print_rows() prints rows as they come.
void print_head(const BenchPlan& plan);
void print_rows(const std::vector<Measurement>& figures);

[[nodiscard]] Json json_of(const BenchPlan& plan, const std::vector<Measurement>& figures);

/// Vertex visits per second over the mesh's size, one line per series.
[[nodiscard]] LinePlot plot_of(const std::vector<Measurement>& figures);

}  // namespace dmoscope::app
