#pragma once
// Plan of `dmoscope bench`, made from its options and checked before anything is generated.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/common/memory_limit.h"
#include "core/numeric/simd.h"
#include "core/quality/metric.h"
#include "core/smooth/composite_objective.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

/// The options as given; the lists are separated by commas.
struct BenchOptions {
  std::filesystem::path file, plot;
  std::string sizes = "1e4,1e5,1e6";
  std::string threads = "1,0";
  std::string metric = "mean-ratio";
  std::string combine;  // FIRST:THRESHOLD:SECOND; empty: one metric alone
  std::string elements = "triangles";
  std::string simd = "auto";
  std::string backend = "auto";
  std::size_t repeats = 5;
  std::uint64_t iterations = 4;
  std::uint64_t active = 0;
  std::uint64_t draw = 0;   // frames to draw instead; 0: none
  bool end_to_end = false;  // adds a column
  std::uint64_t seek = 0;   // seeks to make instead; 0: none
  bool window = false;      // open a mesh in the window instead
  bool full = false;
  bool json = false;
  MemoryLimit memory;
};

/// A mix of elements, and the generator of its meshes.
struct BenchElements {
  std::string_view name;       // "triangles"
  std::string_view generator;  // "grid"
  std::size_t largest;         // size, in vertices
  KindSet kinds;               // kinds of the elements
  [[nodiscard]] bool volume() const noexcept {
    return (kinds & (kind_set(ElementKind::Tetrahedron) | kind_set(ElementKind::Hexahedron))) != 0;
  }
  [[nodiscard]] bool suits(const MetricInfo& metric) const noexcept { return (metric.kinds & kinds) == kinds; }
};
/// All mixes: triangles, quadrilaterals, mixed; tetrahedra, hexahedra, solids.
[[nodiscard]] std::span<const BenchElements> bench_elements();

/// The options, parsed; no list has the same entry twice.
struct BenchPlan {
  std::vector<std::size_t> sizes;               // numbers of vertices of the meshes to generate; empty if a file is given
  std::vector<BenchElements> elements;          // mixes of elements to generate
  std::vector<Metric> metrics;                  // left out for meshes with elements for which they are not defined
  std::optional<CompositeTerms> combination{};  // the one metric with a second aim
  bool all_metrics;                             // asked for as "all", not by their names
  bool cpu = true;                              // whether to measure it, besides the reference
  Acceleration acceleration{};                  // the device to measure besides the CPU, or the reason for none
  std::vector<SimdLevel> levels;                // kinds of instructions of this processor
  std::vector<unsigned> threads;                // at least 1 each
  std::size_t repeats;                          // repeats of every measurement
  std::uint64_t iterations;                     // timed, from the input on
  std::uint64_t active;                         // the iteration whose time is compared with the first's; 0: none
  bool end_to_end = false;                      // whether to show the time from the mesh on the host to the smoothed positions there
};

/// Makes the plan. Throws UsageError for words that do not exist, are out of range, fit no other choice, or need more memory than there is.
[[nodiscard]] BenchPlan plan_of(const BenchOptions& options);

}  // namespace dmoscope::app
