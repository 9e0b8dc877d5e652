#pragma once
// Smoothing: moves vertices so that the worst cell becomes as good as possible; cells and boundary stay.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"
#include "dmoscope/quality.h"

namespace dmo {

/// State at the end of an iteration; number 0 is the input.
struct Iteration {
  std::uint64_t number = 0;
  Statistics statistics;    // by the metric that is raised
  std::uint64_t moved = 0;  // number of vertices that moved
  double seconds = 0.0;     // time of smoothing alone
};

struct SmoothOptions {
  std::optional<std::uint64_t> iterations;  // default 20, but a recipe goes on until_converged; ignored if that is set
  bool until_converged = false;             // ends once no vertex moves or the minimum no longer rises, and returns the best iteration
  unsigned threads = 0;                     // 0: all processors, up to 1024; the result does not depend on it
  std::vector<Index> fixed;                 // vertices that stay, besides the boundary
  /// Long options of `dmoscope smooth` without their dashes, and their values: {"metric", "min-angle"}, {"boundary", "slide"}, {"then",
  /// "mean"}, {"combine", "mean-ratio:0.7:min-angle"}, {"fix", "group:wall"} ... Not available: corner, feature, their opposites, surface,
  /// and options about files.
  std::map<std::string, std::string> options;
  /// Called after each iteration, on the thread that called smooth(). If it returns false, smooth() ends with the result so far.
  std::function<bool(const Iteration&)> after_iteration;
  Progress progress;
};

struct Smoothed {
  Mesh mesh;
  std::vector<Iteration> history;     // history[0] is the input
  std::uint64_t iteration = 0;        // number of the iteration whose end is `mesh`
  bool converged = false;             // whether until_converged was reached
  bool cancelled = false;             // whether after_iteration or progress ended it; `mesh` is the result until then
  std::string sentence;               // reason for the end: "converged: no vertex moved any more; ..."
  std::vector<std::string> warnings;  // sentences for the user
  std::string fields;                 // changes of the point data: "depth was taken anew at the new places ..."; empty without any
};

/// Smooths the mesh. The positions have the bits that `dmoscope smooth` writes. Throws UsageError for options that do not fit the mesh.
[[nodiscard]] DMO_API Smoothed smooth(const Mesh& mesh, const SmoothOptions& options = {});

}  // namespace dmo
