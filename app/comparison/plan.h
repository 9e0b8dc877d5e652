#pragma once
// The request of `dmoscope compare`, and the runs that it makes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "app/common/memory_limit.h"
#include "app/common/run_options.h"
#include "app/common/shared_options.h"

namespace dmoscope::app {

struct CompareOptions {
  std::filesystem::path file, surface, stats, table, plot, report;
  std::vector<std::string> materials;
  std::vector<std::string> runs;   // METHOD[:METRIC[:BACKEND]][,alone|,then mean]
  std::vector<std::string> every;  // "method", "metric"
  RunOptions run;                  // defaults for the parts that a SPEC omits
  std::string judge;               // empty: the first run's metric
  Goal goal;
  std::uint64_t shuffles = 0;
  MemoryLimit memory;
  ReadingOptions reading;
  bool json = false;
};

/// A run of the comparison, either named, then it must be possible, or made by --every, which leaves out impossible runs.
struct Contender {
  std::string name;  // unique, such as "dmo:mean-ratio"
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

/// Plans the runs, as far as that needs no mesh. Throws UsageError for names that do not exist, and if there is no run.
[[nodiscard]] ComparisonPlan plan_of(const CompareOptions& options);

/// Gives every run these kinds, and leaves out runs of --every that are impossible on this mesh. Throws UsageError for a named run that is
/// impossible, for a judge that is not defined for the mesh, and if no run is left.
void fit_to_mesh(ComparisonPlan& plan, const std::shared_ptr<const InputMesh>& input, const Kinds& kinds);

}  // namespace dmoscope::app
