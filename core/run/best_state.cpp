#include "core/run/best_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

BestState::BestState(const RunParameters& parameters, For use)
    : rule_(parameters.combination                     ? Rule::Last
            : method_info(parameters.method).optimises ? Rule::MinimumThenMean
                                                       : Rule::Values),
      may_cost_mean_(parameters.mean != MeanKind::Arithmetic),
      least_rise_(parameters.then_mean || parameters.then_joint ? std::numeric_limits<double>::denorm_min() : kLeastRise),
      use_(use),
      fits_(parameters.fit > 0.0) {}

void BestState::take(const IterationRecord& record) {
  if (fits_ && record.iteration == 0) return;
  if (!first_ && !is_better(record)) return;
  if (first_) {
    input_ = record.statistics;
    std::tie(minimum_, movable_) = std::tuple(record.statistics.minimum, record.statistics.movable_minimum);
  }
  first_ = false;
  best_ = record.iteration;
  statistics_ = record.statistics;
}

bool BestState::rises(const IterationRecord& record) const {
  const Statistics& now = record.statistics;
  if (now.inverted != statistics_.inverted) return now.inverted < statistics_.inverted;
  const bool keeps_minimum = !(now.minimum < minimum_) && !(now.movable_minimum < movable_);
  if (record.raises_mean && may_cost_mean_ && keeps_minimum) return true;  // the mean that is raised never falls
  // The worst element may have a part between fixed vertices that nothing changes, so that joint moves raise others alone.
  if (record.joint && record.moved > 0 && keeps_minimum) return true;
  // Compares differences: where nothing is movable both are infinite, and that is no rise.
  return now.minimum - minimum_ >= least_rise_ || now.movable_minimum - movable_ >= least_rise_;
}

bool BestState::is_worse_than_input(const Statistics& now) const {
  if (now.inverted != input_.inverted) return now.inverted > input_.inverted;
  // A rise of the minimum by rounding alone does not pay for a lower mean.
  constexpr double kShare = 1e-3;
  const auto rises = [this](double from, double to) {
    return to > from && (use_ == For::NextPhase || to - from >= std::min(kLeastRise, kShare * std::abs(from)));
  };
  const bool risen = rises(input_.minimum, now.minimum) || rises(input_.movable_minimum, now.movable_minimum);
  return now.minimum < input_.minimum || (!risen && now.mean < input_.mean);
}

bool BestState::is_better(const IterationRecord& record) {
  const Statistics& now = record.statistics;
  if (rule_ == Rule::Last) return true;
  if (is_worse_than_input(now)) return false;
  if (rule_ == Rule::MinimumThenMean) {
    if (!rises(record))
      return now.inverted == statistics_.inverted && !(now.minimum < minimum_) && !(now.movable_minimum < movable_) &&
             !(now.mean < statistics_.mean);
    const bool untangled = now.inverted < statistics_.inverted;
    minimum_ = untangled ? now.minimum : std::max(minimum_, now.minimum);
    movable_ = untangled ? now.movable_minimum : std::max(movable_, now.movable_minimum);
    return true;
  }
  const auto worth = [](const Statistics& s) { return std::tuple(-static_cast<double>(s.inverted), s.minimum, s.movable_minimum, s.mean); };
  return !(worth(now) < worth(statistics_));
}

std::uint64_t best_iteration(const RunParameters& parameters, std::span<const IterationRecord> records) {
  BestState best(parameters);
  for (const IterationRecord& record : records) best.take(record);
  return best.iteration();
}

bool joint_moves_lose(const RunParameters& parameters, std::span<const IterationRecord> records) {
  const auto jointly = [](const IterationRecord& record) { return record.joint && record.moved > 0; };
  if (parameters.combination || std::ranges::none_of(records, jointly)) return false;
  BestState state(parameters);
  state.take(records.front());
  return state.is_worse_than_input(records.back().statistics);
}

}  // namespace dmoscope
