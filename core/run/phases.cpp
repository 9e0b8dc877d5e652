#include "core/run/phases.h"

#include <algorithm>

#include "core/run/sweep_after.h"

namespace dmoscope {

std::optional<std::uint64_t> PhaseSwitchDetector::find(const PhaseBegin& next, std::span<const IterationRecord> records,
                                                       std::optional<std::uint64_t> still, bool joint_next, std::uint64_t from) {
  if (records.size() <= from) return std::nullopt;
  if (seen_ <= from) {
    highest_ = records[from].statistics.movable_minimum;
    seen_ = last_rise_ = from;
  }
  for (std::uint64_t i = seen_ + 1; !turn_ && i < records.size(); ++i) {
    seen_ = i;
    const Statistics& now = records[i].statistics;
    // Compares differences: where nothing is movable both are infinite, and that is no rise.
    if (now.movable_minimum - highest_ >= next.rise) {
      highest_ = now.movable_minimum;
      last_rise_ = i;
    }
    // Lets the method's own attempts come first: even those that fail leave less to do. The last one is the iteration after kEnd.
    if (now.inverted > 0 && iterations_since_untangled(records, joint_next ? i : i - 1) < UntanglingPlan::kEnd) continue;
    const auto rests = [](const IterationRecord& record) { return record.moved == 0; };
    const bool at_rest = still && i >= *still && std::ranges::all_of(records.subspan(i + 1 - *still, *still), rests);
    if ((at_rest || i - last_rise_ >= next.patience) && !records[i].raise_follows) turn_ = i;
  }
  return turn_;
}

void PhaseSwitchDetector::forget_after(std::uint64_t iteration) {
  if (iteration < seen_) *this = {};
}

}  // namespace dmoscope
