#include "core/quality/tally.h"

#include <algorithm>
#include <cstdint>

namespace dmoscope {

namespace {

/// Every comparison with NaN is false: it is left out of minimum, sum and count.
template <std::size_t kLanes>
struct Lanes {
  std::array<double, kLanes> sum{}, least;
  std::array<std::uint64_t, kLanes> defined{}, inverted{};

  void add(std::size_t lane, double quality, double jacobian) {
    const bool is_defined = quality == quality;
    sum[lane] += is_defined ? quality : 0.0;
    defined[lane] += is_defined ? 1U : 0U;
    least[lane] = quality < least[lane] ? quality : least[lane];
    inverted[lane] += jacobian <= 0.0 ? 1U : 0U;
  }
};

}  // namespace

void Tally::add(const ElementBlock& block, std::span<const Index> immovable) {
  Lanes<kLanes> lanes;
  lanes.sum = sums_;
  lanes.least.fill(kInfinity);
  const std::size_t whole = block.count / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes.add(lane, block.quality[i + lane], block.jacobian[i + lane]);
  }
  for (std::size_t i = whole; i < block.count; ++i) lanes.add(i - whole, block.quality[i], block.jacobian[i]);
  sums_ = lanes.sum;
  const double least = std::ranges::min(lanes.least);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    defined_ += lanes.defined[lane];
    inverted_ += static_cast<Index>(lanes.inverted[lane]);
  }
  if (least < minimum_) {
    minimum_ = least;
    worst_ = block.first + static_cast<Index>(std::ranges::find(block.qualities(), least) - block.qualities().begin());
  }

  const auto end = static_cast<Index>(block.first + block.count);
  auto fixed = std::ranges::lower_bound(immovable, block.first);
  if (fixed == immovable.end() || *fixed >= end) {
    movable_ = std::min(movable_, least);
    return;
  }
  for (std::size_t i = 0; i < block.count; ++i) {
    const bool is_fixed = fixed != immovable.end() && *fixed == block.first + i;
    if (is_fixed) ++fixed;
    double& bound = is_fixed ? ceiling_ : movable_;
    if (block.quality[i] < bound) bound = block.quality[i];
  }
}

void Tally::append(const Tally& next) {
  if (next.minimum_ < minimum_) {
    minimum_ = next.minimum_;
    worst_ = next.worst_;
  }
  movable_ = std::min(movable_, next.movable_);
  ceiling_ = std::min(ceiling_, next.ceiling_);
  for (std::size_t lane = 0; lane < kLanes; ++lane) sums_[lane] += next.sums_[lane];
  inverted_ += next.inverted_;
  defined_ += next.defined_;
}

Statistics Tally::statistics() const {
  const double sum = (sums_[0] + sums_[1]) + (sums_[2] + sums_[3]);
  const double mean = defined_ > 0 ? sum / static_cast<double>(defined_) : std::numeric_limits<double>::quiet_NaN();
  return {minimum_, mean, movable_, ceiling_, worst_, inverted_};
}

void TallyTotal::append(const Tally& stretch) {
  group_.append(stretch);
  if (++in_group_ < kGroup) return;
  groups_.append(group_);
  group_ = {};
  in_group_ = 0;
}

Statistics TallyTotal::statistics() const {
  Tally all = groups_;
  all.append(group_);
  return all.statistics();
}

}  // namespace dmoscope
