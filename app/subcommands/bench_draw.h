#pragma once
// `dmoscope bench --draw N`: N times an iteration and then its picture.

#include <filesystem>

#include "app/subcommands/bench_plan.h"
#include "core/base/progress.h"

namespace dmoscope::app {

/// Measures the plan's meshes (or `file`) on each of its backends, the CPU with the most threads of the plan, by its first metric, and
/// prints a table, or with `json` one object. Throws UsageError where the program was built without OpenGL, Error and Cancelled.
void bench_drawing(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t frames, bool json, Progress& progress);

}  // namespace dmoscope::app
