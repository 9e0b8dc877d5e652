#pragma once
// The measurements of `dmoscope bench` that draw. All throw UsageError if the program was built without OpenGL, Error and Cancelled.

#include <cstdint>
#include <filesystem>

#include "app/subcommands/bench_plan.h"
#include "core/base/progress.h"

namespace dmoscope::app {

/// Measures `--draw N`: N times an iteration and then its picture. Smooths the plan's meshes (or `file`) on each of its backends, the CPU
/// with the most threads of the plan, by its first metric, and prints a table, or with `json` one object.
void bench_drawing(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t frames, bool json, Progress& progress);

/// Measures `--seek N`: N seeks to random iterations of a run, without and with drawing. Prints one row per mesh.
void bench_seeking(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t seeks, bool json, Progress& progress);

/// Measures `--window`: the costs of a mesh in the window. Opens the file, or else the first of the generated meshes: one per call, since
/// memory is counted from the program's start.
void bench_window(const BenchPlan& plan, const std::filesystem::path& file, bool json, Progress& progress);

}  // namespace dmoscope::app
