#pragma once
// Smoothing: vertices move so that the worst cell becomes as good as it can; cells and boundary stay.

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

/// An iteration's end; number 0 is the input.
struct Iteration {
  std::uint64_t number = 0;
  Statistics statistics;    // of the metric that is raised
  std::uint64_t moved = 0;  // vertices
  double seconds = 0.0;     // of smoothing alone
};

struct SmoothOptions {
  std::optional<std::uint64_t> iterations;  // 20 unless given, but a recipe goes on until_converged; of no account where it is that
  bool until_converged = false;             // until no vertex moves or the minimum no longer rises; gives back the best iteration
  unsigned threads = 0;                     // 0: all processors, up to 1024; the result does not depend on it
  std::vector<Index> fixed;                 // vertices that stay, besides the boundary
  /// The long options of `dmoscope smooth` without their dashes, and their values: {"metric", "min-angle"}, {"boundary", "slide"},
  /// {"then", "mean"}, {"combine", "mean-ratio:0.7:min-angle"}, {"fix", "group:wall"} ... But for corner, feature, their opposites,
  /// surface, and what is about files.
  std::map<std::string, std::string> options;
  /// Called after each iteration, on the thread that called smooth(). False: smooth() ends there, with what it has.
  std::function<bool(const Iteration&)> after_iteration;
  Progress progress;
};

struct Smoothed {
  Mesh mesh;
  std::vector<Iteration> history;     // history[0] is the input
  std::uint64_t iteration = 0;        // the one that `mesh` is the end of
  bool converged = false;             // of until_converged
  bool cancelled = false;             // by after_iteration or progress; `mesh` is what there was then
  std::string sentence;               // why it ended: "converged: no vertex moved any more; ..."
  std::vector<std::string> warnings;  // what a person should know
  std::string fields;                 // what became of the point data: "depth was taken anew at the new places ..."; empty without any
};

/// The positions have the bits that `dmoscope smooth` writes. Throws UsageError for what does not fit the mesh.
[[nodiscard]] DMO_API Smoothed smooth(const Mesh& mesh, const SmoothOptions& options = {});

}  // namespace dmo
