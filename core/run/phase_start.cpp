#include "core/run/phase_start.h"

#include <algorithm>

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

const PhaseBegin* next_phase(const RunParameters& parameters) {
  if (method_info(parameters.method).joint) return nullptr;
  if (parameters.then_joint) return &*parameters.then_joint;
  return parameters.then_mean ? &*parameters.then_mean : nullptr;
}

bool same_state(const Statistics& a, const Statistics& b) {
  return a.inverted == b.inverted && a.minimum == b.minimum && a.movable_minimum == b.movable_minimum && a.mean == b.mean;
}

std::optional<std::uint64_t> next_phase_start(const RunParameters& parameters, std::span<const IterationRecord> records,
                                              std::uint64_t turn) {
  const PhaseBegin* next = next_phase(parameters);
  if (turn == 0 || next == nullptr || !next->from_best) return std::nullopt;
  BestState best(parameters, BestState::For::NextPhase);
  for (const IterationRecord& record : records.first(turn)) best.take(record);
  const std::uint64_t before = best.iteration();
  best.take(records[turn]);
  // Takes the earlier one of equals, so that the answer stays the same once `turn` has its record.
  if (best.iteration() == turn && !same_state(records[before].statistics, records[turn].statistics)) return std::nullopt;
  const auto since = records.subspan(before + 1, turn - before);
  if (std::ranges::all_of(since, [](const IterationRecord& record) { return record.moved == 0; })) return std::nullopt;
  return before;
}

void BestPositions::take(std::span<const IterationRecord> records, std::span<const Vec3> positions) {
  if (seen_ + 1 != records.size()) {
    best_ = BestState(parameters_, BestState::For::NextPhase);
    for (const IterationRecord& record : records.first(records.size() - 1)) best_.take(record);
  }
  best_.take(records.back());
  seen_ = records.size();
  if (best_.iteration() != records.back().iteration) return;
  held_ = best_.iteration();
  positions_.assign(positions.begin(), positions.end());
}

void BestPositions::forget_after(std::uint64_t iteration) {
  seen_ = 0;
  if (held_ && *held_ > iteration) clear();
}

void BestPositions::clear() {
  held_.reset();
  std::vector<Vec3>().swap(positions_);
}

}  // namespace dmoscope
