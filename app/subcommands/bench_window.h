#pragma once
// `dmoscope bench --window`: what a mesh costs in the window.

#include <filesystem>

#include "app/subcommands/bench_plan.h"
#include "core/base/progress.h"

namespace dmoscope::app {

/// Opens the file, or else the first of the generated meshes: one a call, for memory is counted from the program's start. Throws UsageError
/// where the program was built without OpenGL, Error and Cancelled.
void bench_window(const BenchPlan& plan, const std::filesystem::path& file, bool json, Progress& progress);

}  // namespace dmoscope::app
