#pragma once
// A run from the input on, completed and judged by any metric.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/common/hints.h"
#include "core/run/report_card.h"
#include "core/run/run.h"
#include "core/view/run_table.h"

namespace dmoscope::app {

/// The end of a run.
struct Goal {
  std::uint64_t iterations = 20;
  std::optional<ConvergenceLimits> until_converged{};  // replaces the number of iterations
};

struct JudgedRun {
  std::string name;
  RunParameters parameters;
  std::string backend_reason;  // see Run
  std::uint64_t free = 0;      // vertices that may move
  RunRow row;                  // its title is `name`; iterations and seconds are those of all that was done
  Statistics after;            // by the judge, at the run's present iteration: until converged, the best one (see Run::end_at_best)
  Outcome outcome;
  std::string held;  // the hold of the minimum in words, without a full stop, for joint runs with hints; else empty
  ReportCard card;
  std::vector<IterationRecord> records;  // with the judge's statistics; the first is the input
  std::vector<double> qualities;         // qualities of all elements by the judge, ascending
  std::vector<Vec3> positions;
  [[nodiscard]] const Statistics& before() const { return records.front().statistics; }
  [[nodiscard]] bool converged_or_done(const Goal& goal) const {
    return !goal.until_converged || outcome.reason != StopReason::IterationLimit;
  }
};

/// Resources that runs share.
struct Workshop {
  std::shared_ptr<ThreadPool> pool;
  Acceleration acceleration;
  Progress& progress;
  std::function<void(std::string)> warn;
  Hints hints = Hints::On;
};

/// Does the run and judges it. Throws the errors of Run, and UsageError if the judge is not defined for the mesh. If a device fails that
/// was not asked for by name, the CPU does the work, with a warning.
[[nodiscard]] JudgedRun run_judged(std::string name, std::shared_ptr<const InputMesh> input, RunParameters parameters, Metric judge,
                                   const Goal& goal, const Workshop& workshop);

}  // namespace dmoscope::app
