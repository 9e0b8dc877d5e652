#pragma once
// State that the phase after the first begins from.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/run/best_state.h"

namespace dmoscope {

/// Begin of the phase after the first; null: none follows, or the first is one of joint moves, which know themselves when they are over.
[[nodiscard]] const PhaseBegin* next_phase(const RunParameters& parameters);

/// The best iteration before `turn`, the last of the first phase: to its state the run goes back at the end of `turn`. Returns none where
/// `turn` is better than all before it, or where nothing has moved since. After its last rise the minimum has nothing to gain, and the mean
/// falls: see BestState.
[[nodiscard]] std::optional<std::uint64_t> next_phase_start(const RunParameters& parameters, std::span<const IterationRecord> records,
                                                            std::uint64_t turn);

/// Compares two iterations by their records: whether both are one state.
[[nodiscard]] bool same_state(const Statistics& a, const Statistics& b);

/// Positions of the best iteration so far, which need not be computed again.
class BestPositions {
 public:
  explicit BestPositions(const RunParameters& parameters) : best_(parameters, BestState::For::NextPhase), parameters_(parameters) {}
  /// Takes each new record: `positions` are those of the last.
  void take(std::span<const IterationRecord> records, std::span<const Vec3> positions);
  /// Positions of an iteration; null where those held are of another one.
  [[nodiscard]] const std::vector<Vec3>* find(std::uint64_t iteration) const {
    return held_ && *held_ == iteration ? &positions_ : nullptr;
  }
  /// Forgets the records after an iteration, which belong to another path.
  void forget_after(std::uint64_t iteration);
  /// Frees the positions, which will not be asked for any more.
  void clear();

 private:
  BestState best_;
  RunParameters parameters_;
  std::uint64_t seen_ = 0;  // records
  std::optional<std::uint64_t> held_;
  std::vector<Vec3> positions_;
};

}  // namespace dmoscope
