#pragma once
// `dmoscope bench --seek N`: N seeks to random iterations of a run, without and with drawing.

#include <cstdint>

#include "app/subcommands/bench_plan.h"
#include "core/base/progress.h"

namespace dmoscope::app {

/// Prints one row per mesh. Throws UsageError where the program was built without OpenGL, Error and Cancelled.
void bench_seeking(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t seeks, bool json, Progress& progress);

}  // namespace dmoscope::app
