#pragma once
// A run from the input on, done and judged by any metric.

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

/// How far runs go.
struct Goal {
  std::uint64_t iterations = 20;
  std::optional<ConvergenceLimits> until_converged{};  // instead
};

struct JudgedRun {
  std::string name;
  RunParameters parameters;
  std::string backend_reason;  // see Run
  std::uint64_t free = 0;      // vertices that may move
  RunRow row;                  // its title is `name`; iterations and seconds are those of all that was done
  Statistics after;            // by the judge, where the run stands: until converged, at its best iteration (see Run::end_at_best)
  Outcome outcome;
  std::string held;  // of a run that moved vertices jointly, with hints: what holds its minimum, without a point; else empty
  ReportCard card;
  std::vector<IterationRecord> records;  // their statistics are the judge's; the first is the input
  std::vector<double> qualities;         // of all elements by the judge, ascending
  std::vector<Vec3> positions;
  [[nodiscard]] const Statistics& before() const { return records.front().statistics; }
  [[nodiscard]] bool converged_or_done(const Goal& goal) const {
    return !goal.until_converged || outcome.reason != StopReason::IterationLimit;
  }
};

/// What runs share.
struct Workshop {
  std::shared_ptr<ThreadPool> pool;
  Acceleration acceleration;
  Progress& progress;
  std::function<void(std::string)> warn;
  Hints hints = Hints::On;
};

/// Throws what Run does, and UsageError when the judge is not defined for the mesh. Where a device fails that was not
/// asked for by name, a message says so and the CPU does the work.
[[nodiscard]] JudgedRun run_judged(std::string name, std::shared_ptr<const InputMesh> input, RunParameters parameters, Metric judge,
                                   const Goal& goal, const Workshop& workshop);

}  // namespace dmoscope::app
