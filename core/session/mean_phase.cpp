#include "core/session/mean_phase.h"

#include <algorithm>

namespace dmoscope {

std::optional<std::uint64_t> PhaseTurn::find(const MeanPhase& phase, std::span<const IterationRecord> records,
                                             std::optional<std::uint64_t> still) {
  for (std::uint64_t i = seen_ + 1; !turn_ && i < records.size(); ++i) {
    seen_ = i;
    const std::uint64_t since = i >= phase.patience ? i - phase.patience : 0;
    // With the minimum of all elements that of the movable ones rises as much. As a difference: where nothing is movable both are infinite,
    // and that is no rise.
    const bool rose = records[i].statistics.movable_minimum - records[since].statistics.movable_minimum >= phase.rise;
    const bool waited = i >= phase.patience && !rose;
    const auto rests = [](const IterationRecord& record) { return record.moved == 0; };
    const bool at_rest = still && i >= *still && std::ranges::all_of(records.subspan(i + 1 - *still, *still), rests);
    if (waited || at_rest) turn_ = i;
  }
  return turn_;
}

void PhaseTurn::forget_after(std::uint64_t iteration) {
  if (turn_ && *turn_ > iteration) turn_.reset();
  seen_ = std::min(seen_, iteration);
}

}  // namespace dmoscope
