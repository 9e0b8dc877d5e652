#pragma once
// The measurements of `dmoscope bench`: smoothing alone, without loading, colouring or statistics.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/subcommands/bench_plan.h"
#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/search/parameters.h"

namespace dmoscope::app {

/// Statistics over one measurement's repeats.
struct Spread {
  double median = 0.0, lowest = 0.0, highest = 0.0;
};

/// Time of a late iteration, which skips settled vertices, beside that of the first.
struct Settling {
  std::uint64_t iteration = 0;                // the late one, counted from 1
  double first_seconds = 0.0, seconds = 0.0;  // medians of the first and of the late one
};

struct Measurement {
  std::string mesh;           // the mesh that was smoothed: "grid 100000" or a file's name
  std::string_view elements;  // "triangles", see bench_elements()
  Index vertices = 0;
  std::uint64_t free = 0;
  Metric metric = Metric::MeanRatio;
  std::optional<CompositeTerms> combination;  // the metric combined with a second aim
  std::string method;
  Backend backend = Backend::Cpu;
  Precision precision = Precision::Float;
  std::optional<SimdLevel> simd;  // none: scalar, or a device
  unsigned threads = 1;
  std::uint64_t iterations = 0;              // timed
  Spread seconds;                            // all timed iterations
  Spread prepare_seconds;                    // from the mesh to the first visit: colouring, stars, a device's data
  Spread step_seconds;                       // one iteration by the clock, with its statistics and all else of the run
  std::optional<Spread> end_to_end_seconds;  // from the mesh on the host to the smoothed positions there: preparation, copies, iterations
  bool reference = false;
  Index subject_vertices = 0;                // size of the mesh that the reference was measured for; other measurements: vertices
  double reference_vertices_per_second = 0;  // the reference's, measured in turn with this one
  std::optional<Settling> settling;

  [[nodiscard]] double visits() const noexcept { return static_cast<double>(free * iterations); }
  [[nodiscard]] double vertices_per_second() const noexcept { return visits() / seconds.median; }
  [[nodiscard]] double iterations_per_second() const noexcept { return static_cast<double>(iterations) / seconds.median; }
  /// Share of preparing in the time of preparing and these iterations.
  [[nodiscard]] double prepare_share() const noexcept {
    return prepare_seconds.median / (prepare_seconds.median + static_cast<double>(iterations) * step_seconds.median);
  }
  [[nodiscard]] bool on_cpu() const noexcept { return backend == Backend::Cpu; }
  [[nodiscard]] double ns_per_visit() const noexcept { return 1e9 * seconds.median / visits(); }
  [[nodiscard]] double ratio() const noexcept { return vertices_per_second() / reference_vertices_per_second; }
};

/// Receives the figures of each mesh as soon as they are measured: for every metric the reference first.
using TakeFigures = std::function<void(const std::vector<Measurement>&)>;

/// Measures the plan on `file`, or if that is empty on generated meshes, one after the other. Throws Error and Cancelled.
///
/// The reference of every ratio is the plain scalar search in double on one thread. It is slow and its cost per visit does not depend on
/// the mesh's size, so for a mesh with more than 20,000 free vertices (a volume 2,000) it is measured on a generated one of 10,000 (2,000)
/// with the same kinds of elements. The repeats of all measurements of a mesh, the references included, take turns: a neighbour's noise
/// hits all alike.
void measure(const BenchPlan& plan, const std::filesystem::path& file, Progress& progress, const TakeFigures& take);

}  // namespace dmoscope::app
