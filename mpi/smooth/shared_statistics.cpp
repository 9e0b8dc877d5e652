#include "mpi/smooth/shared_statistics.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/quality/element_block.h"
#include "core/quality/tally.h"

namespace dmoscope {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kElementsAtOnce = 8192;

/// What the elements that a rank counts have; a minimum with its element's number in the whole mesh.
struct Extremes {
  double minimum = kInfinity, movable = kInfinity, ceiling = kInfinity;
  WholeIndex worst = std::numeric_limits<WholeIndex>::max();
  std::uint64_t inverted = 0;

  void take(const Extremes& other) {
    if (other.minimum < minimum || (other.minimum == minimum && other.worst < worst)) {
      minimum = other.minimum;
      worst = other.worst;
    }
    movable = std::min(movable, other.movable);
    ceiling = std::min(ceiling, other.ceiling);
    inverted += other.inverted;
  }
};

}  // namespace

SharedStatistics::SharedStatistics(const World& world, const Share& share)
    : world_(world), share_(&share), stretches_(share.element_count, world.size(), Tally::kStretch) {
  Dealer<std::uint32_t> dealer(world.size());
  for (Index e = 0; e < share.home.size(); ++e) {
    if (share.home[e] == 0) continue;
    to_.push_back(e);  // ascending, so by rank
    dealer.count(stretches_.holder(share.elements[e]));
  }
  dealer.begin();
  to_offsets_ = dealer.parts().offsets;
  for (const Index e : to_) {
    const int rank = stretches_.holder(share.elements[e]);
    dealer.put(rank, static_cast<std::uint32_t>(share.elements[e] - stretches_.begin(rank)));
  }
  places_ = world.exchange(dealer.take());
}

SharedStatistics::Sum SharedStatistics::sum(std::span<const double> values) const {
  std::vector<double> mine;
  mine.reserve(to_.size());
  for (const Index e : to_) mine.push_back(values[e]);
  std::vector<double> came(places_.values.size());
  world_.exchange<double>(mine, to_offsets_, came, places_.offsets);
  std::vector<double> in_order(stretches_.count(world_.rank()));
  for (std::size_t i = 0; i < came.size(); ++i) in_order[places_.values[i]] = came[i];

  // As Tally adds.
  using Lanes = std::array<double, Tally::kLanes>;
  std::vector<Lanes> sums;
  std::uint64_t defined = 0;
  for (std::size_t first = 0; first < in_order.size(); first += Tally::kStretch) {
    Lanes lanes{};
    const std::size_t last = std::min(first + Tally::kStretch, in_order.size());
    for (std::size_t e = first; e < last; ++e) {
      const bool is_defined = in_order[e] == in_order[e];
      lanes[(e - first) % Tally::kLanes] += is_defined ? in_order[e] : 0.0;
      defined += is_defined ? 1 : 0;
    }
    sums.push_back(lanes);
  }
  Lanes total{};
  for (const Lanes& lanes : world_.gather(sums))
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) total[lane] += lanes[lane];
  world_.broadcast(total, 0);
  return {(total[0] + total[1]) + (total[2] + total[3]), world_.sum(defined)};
}

Statistics SharedStatistics::of(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                std::span<const Index> immovable, ThreadPool* pool) const {
  const std::size_t count = share_->home.size();
  std::vector<double> qualities(count);
  std::vector<Extremes> parts((count + kElementsAtOnce - 1) / kElementsAtOnce);
  for_chunks(pool, count, kElementsAtOnce, [&](std::size_t first, std::size_t last) {
    Extremes here;
    auto fixed = std::ranges::lower_bound(immovable, static_cast<Index>(first));
    for_blocks(context, positions, metric, first, last, [&](const ElementBlock& block) {
      std::ranges::copy(block.qualities(), qualities.begin() + block.first);
      for (std::size_t i = 0; i < block.count; ++i) {
        const auto e = static_cast<Index>(block.first + i);
        const bool is_fixed = fixed != immovable.end() && *fixed == e;
        if (is_fixed) ++fixed;
        if (share_->home[e] == 0) continue;
        const double quality = block.quality[i];
        here.inverted += block.jacobian[i] <= 0.0 ? 1U : 0U;
        if (quality < here.minimum) {
          here.minimum = quality;
          here.worst = share_->elements[e];
        }
        double& bound = is_fixed ? here.ceiling : here.movable;
        if (quality < bound) bound = quality;
      }
    });
    parts[first / kElementsAtOnce] = here;
  });
  Extremes total;
  for (const Extremes& part : parts) total.take(part);
  Extremes all;
  for (const Extremes& one : world_.all_of(total)) all.take(one);
  const Sum sum = this->sum(qualities);
  const double mean = sum.count > 0 ? sum.sum / static_cast<double>(sum.count) : std::numeric_limits<double>::quiet_NaN();
  const Index worst = all.worst < kNoIndex ? static_cast<Index>(all.worst) : kNoIndex;
  return {all.minimum, mean, all.movable, all.ceiling, worst, static_cast<Index>(std::min<std::uint64_t>(all.inverted, kNoIndex))};
}

}  // namespace dmoscope
