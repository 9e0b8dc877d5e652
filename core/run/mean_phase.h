#pragma once
// The second phase of a run, which raises the mean: when it begins.

#include <cstdint>
#include <optional>
#include <span>

#include "core/run/history.h"

namespace dmoscope {

/// Once no element is inverted and the minimum has converged, the mean quality of the stars is raised, with the movable minimum as floor:
/// max-min alone lowers the mean.
struct MeanPhase {
  std::uint64_t patience = 200;  // at least 1: iterations without a rise of the movable minimum by `rise`; or nothing moves any more
  double rise = 1e-6;
  bool from_best = true;  // it begins with the best state of the first phase; else with the last, as in session files of before
  friend bool operator==(const MeanPhase&, const MeanPhase&) = default;
};

/// Finds the end of the first phase among the records of a path, each looked at once.
class PhaseSwitchDetector {
 public:
  /// The iteration at whose end the first phase is over; none: not within these records. `still`: see still_iterations().
  [[nodiscard]] std::optional<std::uint64_t> find(const MeanPhase& phase, std::span<const IterationRecord> records,
                                                  std::optional<std::uint64_t> still = 1);
  /// The records after an iteration are of another path from now on.
  void forget_after(std::uint64_t iteration);

 private:
  std::optional<std::uint64_t> turn_;
  std::uint64_t seen_ = 0;  // records up to this iteration have no turn before turn_
  std::uint64_t last_rise_ = 0;
  double highest_ = 0.0;  // movable minimum, at the last rise
};

}  // namespace dmoscope
