#include "core/session/history.h"

#include <algorithm>

#include <fmt/format.h>

namespace dmoscope {

void History::record(const IterationRecord& record, const std::vector<Vec3>& positions) {
  if (record.iteration < records_.size()) return;
  records_.push_back(record);
  if (record.iteration % stride_ != 0) return;
  kept_.push_back({record.iteration, positions});
  thin();
}

const History::Kept& History::nearest(std::uint64_t iteration) const {
  const auto after = std::ranges::upper_bound(kept_, iteration, {}, &Kept::iteration);
  return *std::prev(after);
}

void History::set_budget(std::size_t bytes) {
  budget_ = bytes;
  thin();
}

std::size_t History::bytes() const noexcept {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.positions.size() * sizeof(Vec3);
  return sum;
}

void History::thin() {
  while (bytes() > budget_ && kept_.size() > 1) {
    stride_ *= 2;
    std::erase_if(kept_, [&](const Kept& kept) { return kept.iteration % stride_ != 0; });
  }
}

std::string History::sentence() const {
  if (stride_ == 1) return {};
  return fmt::format(
      "history budget of {} MiB reached: positions are kept every {} iterations, those in between are computed again when asked for",
      budget_ >> 20U, stride_);
}

}  // namespace dmoscope
