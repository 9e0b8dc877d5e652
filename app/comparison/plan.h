#pragma once
// What `dmoscope compare` is asked for, and which runs that makes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "app/common/memory_limit.h"
#include "app/common/reading_options.h"
#include "app/common/run_options.h"

namespace dmoscope::app {

struct CompareOptions {
  std::filesystem::path file, surface, stats, table, plot, report;
  std::vector<std::string> materials;
  std::vector<std::string> runs;   // METHOD[:METRIC[:BACKEND]][,alone|,then mean]
  std::vector<std::string> every;  // "method", "metric"
  RunOptions run;                  // what a SPEC leaves open
  std::string judge;               // empty: the first run's metric
  Goal goal;
  std::uint64_t shuffles = 0;
  MemoryLimit memory;
  ReadingOptions reading;
  bool json = false;
};

/// A run that was asked for: by name, then it must be possible; or by --every, which leaves out impossible runs.
struct Contender {
  std::string name;  // "dmo:mean-ratio"; no two have the same
  RunParameters parameters;
  bool by_every = false;
};
struct LeftOut {
  std::string name, reason;
};

struct ComparisonPlan {
  std::vector<Contender> contenders;
  std::vector<LeftOut> left_out;
  Metric judge = Metric::MeanRatio;
  Acceleration acceleration;
};

/// The runs, as far as that can be said without the mesh. Throws UsageError for what does not exist, and when there is none.
[[nodiscard]] ComparisonPlan plan_of(const CompareOptions& options);

/// Gives every run these kinds, and leaves out what --every asked for and cannot be on this mesh. Throws UsageError for
/// a run that was asked for by name and cannot be, for a judge that is not defined for the mesh, and when nothing is left.
void fit_to_mesh(ComparisonPlan& plan, const std::shared_ptr<const InputMesh>& input, const Kinds& kinds);

}  // namespace dmoscope::app
