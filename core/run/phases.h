#pragma once
// The phases of a run: its method's, then joint moves, then the rise of the mean; and where they begin.

#include <cstdint>
#include <optional>
#include <span>

#include "core/run/history.h"

namespace dmoscope {

/// When the phase after the method's begins: once the minimum has converged.
struct PhaseBegin {
  std::uint64_t patience = 200;  // at least 1: iterations without a rise of the movable minimum by `rise`; or nothing moves any more
  double rise = 1e-6;
  bool from_best = true;  // it begins with the best state of the first phase; else with the last, as in session files of before
  friend bool operator==(const PhaseBegin&, const PhaseBegin&) = default;
};

enum class Phase { Method, Joint, Mean };

/// Where the later phases of a run begin, as far as is known.
struct RunPhases {
  std::optional<std::uint64_t> joint_since{};  // the iteration at whose end joint moves begin
  std::optional<std::uint64_t> joint_from{};   // the iteration to whose state the run goes back for that, where it is not the same
  std::optional<std::uint64_t> joint_over{};   // the iteration in which they find nothing more to do
  std::optional<std::uint64_t> mean_since{};   // the iteration at whose end the mean begins to be raised
  std::optional<std::uint64_t> mean_from{};    // as joint_from
  /// Which one an iteration belongs to.
  [[nodiscard]] Phase of(std::uint64_t iteration) const noexcept {
    if (mean_since && *mean_since < iteration) return Phase::Mean;
    return joint_since && *joint_since < iteration ? Phase::Joint : Phase::Method;
  }
  friend bool operator==(const RunPhases&, const RunPhases&) = default;
};

/// What is done with elements that the first phase leaves inverted.
enum class Inverted {
  Wait,  // the next phase can do nothing for them: it does not begin
  Leave  // the next phase untangles them
};

/// Finds the end of the first phase among the records of a path, each looked at once.
class PhaseSwitchDetector {
 public:
  /// The iteration at whose end the first phase is over; none: not within these records. `still`: see still_iterations().
  [[nodiscard]] std::optional<std::uint64_t> find(const PhaseBegin& next, std::span<const IterationRecord> records,
                                                  std::optional<std::uint64_t> still = 1, Inverted inverted = Inverted::Wait);
  /// The records after an iteration are of another path from now on.
  void forget_after(std::uint64_t iteration);

 private:
  std::optional<std::uint64_t> turn_;
  std::uint64_t seen_ = 0;  // records up to this iteration have no turn before turn_
  std::uint64_t last_rise_ = 0;
  double highest_ = 0.0;  // movable minimum, at the last rise
};

}  // namespace dmoscope
