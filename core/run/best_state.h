#pragma once
// The best of the iterations that a run passes through.

#include <cstdint>
#include <span>

#include "core/run/history.h"
#include "core/run/parameters.h"

namespace dmoscope {

/// Least rise of a quality over iterations that counts: smaller ones are no reason to go on, nor to give up any of the mean.
inline constexpr double kLeastRise = 1e-6;

/// The best iteration, from records that are told one after another, the input's first.
/// - For a method that optimises: the one of greatest mean since an element was last untangled, a minimum last rose by kLeastRise, or joint
///   moves raised what they can change. The minimum does not rise noticeably any more there, but goes on to cost the mean. Where another
///   phase follows, any rise counts: it begins with the best state, and must not lower the minimum.
/// - For any other method: fewest inverted elements, then greatest minimum, then greatest movable minimum, then greatest mean.
/// - For a run that draws vertices to a surface: none before it has done so.
/// - For a run with two aims, which gives up some of the first for the second: the last.
/// For a run by one metric, never one that is worse than the input by fewest inverted elements, then greatest minimum (a rise of less than
/// kLeastRise, or a thousandth where that is less, is none), then greatest mean. Among equals the last.
class BestState {
 public:
  /// Use of the best state: as the result that is written, or as the begin of the next phase, which must not lower the minimum by anything.
  enum class For : std::uint8_t { Result, NextPhase };
  explicit BestState(const RunParameters& parameters, For use = For::Result);
  void take(const IterationRecord& record);
  [[nodiscard]] std::uint64_t iteration() const noexcept { return best_; }
  /// Compares with the input by the number of inverted elements, then the minimum, then the mean.
  [[nodiscard]] bool is_worse_than_input(const Statistics& now) const;

 private:
  enum class Rule { MinimumThenMean, Values, Last };
  [[nodiscard]] bool is_better(const IterationRecord& record);
  [[nodiscard]] bool rises(const IterationRecord& record) const;

  Rule rule_;
  bool may_cost_mean_;  // whether the phase that raises another mean than the statistics' may cost some of that
  double least_rise_;   // Rule::MinimumThenMean
  For use_;
  bool first_ = true, fits_;  // fits_: the input lies beside the surface to which it is drawn, and does not count
  std::uint64_t best_ = 0;
  Statistics input_, statistics_;         // statistics of the input and of the best iteration
  double minimum_ = 0.0, movable_ = 0.0;  // Rule::MinimumThenMean: at the last rise
};

/// Best iteration of these records, of which there must be at least one.
[[nodiscard]] std::uint64_t best_iteration(const RunParameters& parameters, std::span<const IterationRecord> records);

/// Returns whether joint moves are among these records and the last is worse than the input: they look at the minimum alone, and where that
/// does not rise they may cost the mean. Never for two aims.
[[nodiscard]] bool joint_moves_lose(const RunParameters& parameters, std::span<const IterationRecord> records);

}  // namespace dmoscope
