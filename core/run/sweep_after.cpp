#include "core/run/sweep_after.h"

namespace dmoscope {

std::uint64_t iterations_since_untangled(std::span<const IterationRecord> records, std::uint64_t iteration) {
  std::uint64_t since = 0;
  while (since < UntanglingPlan::kEnd && since < iteration &&
         records[iteration - since].statistics.inverted >= records[iteration - since - 1].statistics.inverted)
    ++since;
  return since;
}

namespace {

/// Whether each iteration so far, of at most a few, left fewer inverted elements than it found.
bool repairs(std::span<const IterationRecord> records, std::uint64_t iteration) {
  if (iteration >= UntanglingPlan::kRepairs) return false;
  for (std::uint64_t i = 0; i < iteration; ++i)
    if (records[i + 1].statistics.inverted >= records[i].statistics.inverted) return false;
  return true;
}

}  // namespace

bool untangles_jointly(std::span<const IterationRecord> records, std::uint64_t iteration, bool strays) {
  if (records[iteration].statistics.inverted == 0) return false;
  if (strays && repairs(records, iteration)) return false;
  if (iteration == 0 || (strays && repairs(records, iteration - 1))) return true;
  return iterations_since_untangled(records, iteration) == UntanglingPlan::kEnd &&
         iterations_since_untangled(records, iteration - 1) < UntanglingPlan::kEnd;
}

Sweep sweep_after(std::span<const IterationRecord> records, std::uint64_t iteration, const MeanPhase& mean, bool strays) {
  const Statistics& now = records[iteration].statistics;
  Sweep sweep{.iteration = iteration};
  if (mean.since && *mean.since <= iteration) {
    sweep.mean = mean.kind;
    sweep.floor = now.movable_minimum;
    sweep.second_floor = records[iteration].second;
  }
  if (now.inverted == 0) return sweep;
  const std::uint64_t since = iterations_since_untangled(records, iteration);
  const std::uint64_t in_cycle = since % UntanglingPlan::kCycle;
  sweep.untangling.attempt = since < UntanglingPlan::kEnd && in_cycle >= 1 && in_cycle <= UntanglingPlan::kAttempt;
  sweep.untangling.repair = strays && repairs(records, iteration);
  sweep.untangling.floor = now.movable_minimum;
  return sweep;
}

}  // namespace dmoscope
