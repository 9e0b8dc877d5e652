#pragma once
// The phases of a run: its method's, then joint moves, then the rise of the mean; and where they begin.

#include <cstdint>
#include <optional>
#include <span>

#include "core/run/history.h"

namespace dmoscope {

/// Condition for the begin of the phase after the method's: that the minimum has converged.
struct PhaseBegin {
  std::uint64_t patience = 200;  // at least 1: iterations without a rise of the movable minimum by `rise`; or nothing moves any more
  double rise = 1e-6;
  bool from_best = true;  // begins with the best state of the first phase; else with the last, as older session files have it
  friend bool operator==(const PhaseBegin&, const PhaseBegin&) = default;
};

enum class Phase { Method, Joint, Mean };

/// Begins of the later phases of a run, as far as known.
struct RunPhases {
  std::optional<std::uint64_t> joint_since{};  // the iteration at whose end joint moves begin
  std::optional<std::uint64_t> joint_from{};   // the iteration to whose state the run goes back then, where it is not the same
  std::optional<std::uint64_t> joint_over{};   // the iteration in which they find nothing more to do
  std::optional<std::uint64_t> mean_since{};   // the iteration at whose end the mean begins to be raised
  std::optional<std::uint64_t> mean_from{};    // the iteration to whose state the run goes back then, where it is not the same
  /// Phase that an iteration belongs to.
  [[nodiscard]] Phase of(std::uint64_t iteration) const noexcept {
    if (mean_since && *mean_since < iteration) return Phase::Mean;
    return joint_since && *joint_since < iteration ? Phase::Joint : Phase::Method;
  }
  friend bool operator==(const RunPhases&, const RunPhases&) = default;
};

/// Finds the end of the first phase among the records of a path, each looked at once.
class PhaseSwitchDetector {
 public:
  /// Iteration at whose end the first phase is over; none: not within these records. `still`: see still_iterations(). `from`: the iteration
  /// from whose state on rises count. Elements may stay inverted: what the method attempts for them comes first, but for its last attempt,
  /// joint moves, where these come next in any case.
  [[nodiscard]] std::optional<std::uint64_t> find(const PhaseBegin& next, std::span<const IterationRecord> records,
                                                  std::optional<std::uint64_t> still = 1, bool joint_next = false, std::uint64_t from = 0);
  /// Forgets the records after an iteration, which belong to another path.
  void forget_after(std::uint64_t iteration);

 private:
  std::optional<std::uint64_t> turn_;
  std::uint64_t seen_ = 0;  // number of records looked at, none of which has a turn before turn_
  std::uint64_t last_rise_ = 0;
  double highest_ = 0.0;  // movable minimum at the last rise
};

}  // namespace dmoscope
