#pragma once
// What `dmoscope bench` tells: a table for a person, one JSON object, a plot.

#include <filesystem>
#include <vector>

#include "app/text.h"
#include "app/verbs/bench_measure.h"

namespace dmoscope::app {

/// What the figures depend on, and what the columns are; then print_rows() as they come.
void print_head(const BenchPlan& plan);
void print_rows(const std::vector<Figure>& figures);

[[nodiscard]] Json json_of(const BenchPlan& plan, const std::vector<Figure>& figures);

/// Throws UsageError when write_plot() could not write this kind of file, OutputError when it could not write there.
void require_plot_target(const std::filesystem::path& path);
/// Vertex visits a second over the mesh's size, a line a series: an .svg, or a .png where the program was built with its window. Throws
/// OutputError.
void write_plot(const std::filesystem::path& path, const std::vector<Figure>& figures);

}  // namespace dmoscope::app
