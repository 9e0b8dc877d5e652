#include "mpi/smooth/shared_statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/quality/element_block.h"
#include "core/quality/tally.h"

namespace dmoscope {

namespace {

constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;

/// Converts back from whole numbers that have the order of the doubles.
double double_of(std::uint64_t key) { return std::bit_cast<double>((key & kSign) != 0 ? key ^ kSign : ~key); }

std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits ^ kSign;
}

}  // namespace

std::vector<double> values_of_ranks(const World& world, std::span<const double> here, std::span<const std::uint64_t> ranks) {
  // Finds the keys bit by bit: each is the greatest with no more than `rank` values below it.
  std::vector<std::uint64_t> keys(ranks.size(), 0), below(ranks.size());
  for (std::uint64_t bit = kSign; bit > 0; bit >>= 1U) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::uint64_t wanted = keys[i] | bit;
      const auto first = std::partition_point(here.begin(), here.end(), [&](double value) { return key_of(value) < wanted; });
      below[i] = static_cast<std::uint64_t>(first - here.begin());
    }
    world.sum(below);
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (below[i] <= ranks[i]) keys[i] |= bit;
  }
  std::vector<double> values;
  for (const std::uint64_t key : keys) values.push_back(double_of(key));
  return values;
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kElementsAtOnce = 8192;

/// Extremes over the elements that a rank counts; a minimum with its element's number in the whole mesh.
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

using Lanes = std::array<double, Tally::kLanes>;

void add(Lanes& sums, const Lanes& more) {
  for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += more[lane];
}

/// Number of stretches, or groups of them, up to an element that ends one.
std::uint64_t up_to(std::uint64_t elements, std::uint64_t size) { return (elements + size - 1) / size; }

}  // namespace

SharedStatistics::SharedStatistics(const World& world, const Share& share)
    : world_(world), share_(&share), stretches_(share.element_count, world.size(), Tally::kStretch) {
  for (Index e = 0; e < share.home.size(); ++e)
    if (share.home[e] != 0) to_.push_back(e);  // ascending, hence by rank
  const Parts<std::uint32_t> to = deal<std::uint32_t>(world, [&](const auto& give) {
    for (const Index e : to_) {
      const int rank = stretches_.holder(share.elements[e]);
      give(rank, static_cast<std::uint32_t>(share.elements[e] - stretches_.begin(rank)));
    }
  });
  to_offsets_ = to.offsets;
  places_ = world.exchange(to);

  // The stretches that a rank has and those that it adds up are both consecutive: it sends the intersection.
  const std::uint64_t stretches = up_to(share.element_count, Tally::kStretch);
  groups_ = Ranges(up_to(stretches, TallyTotal::kGroup), world.size());
  const auto have = [&](int rank, bool end) { return up_to(end ? stretches_.end(rank) : stretches_.begin(rank), Tally::kStretch); };
  const auto adds = [&](int rank, bool end) {
    return std::min(stretches, TallyTotal::kGroup * (end ? groups_.end(rank) : groups_.begin(rank)));
  };
  sums_to_ = sums_from_ = {0};
  for (int rank = 0; rank < world.size(); ++rank) {
    const auto common = [&](int has, int sums) {
      const std::uint64_t first = std::max(have(has, false), adds(sums, false)), last = std::min(have(has, true), adds(sums, true));
      return last > first ? last - first : 0;
    };
    sums_to_.push_back(sums_to_.back() + common(world.rank(), rank));
    sums_from_.push_back(sums_from_.back() + common(rank, world.rank()));
  }
}

SharedStatistics::Sum SharedStatistics::sum(std::span<const double> values) const {
  mine_.resize(to_.size());
  for (std::size_t i = 0; i < to_.size(); ++i) mine_[i] = values[to_[i]];
  return sum_of_mine();
}

SharedStatistics::Sum SharedStatistics::sum_of_mine() const {
  came_.resize(places_.values.size());
  world_.exchange<double>(mine_, to_offsets_, came_, places_.offsets);
  std::vector<double>& in_order = in_order_;
  in_order.resize(stretches_.count(world_.rank()));
  for (std::size_t i = 0; i < came_.size(); ++i) in_order[places_.values[i]] = came_[i];

  // Adds in the order of Tally and TallyTotal.
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
  std::vector<Lanes> of_groups(sums_from_.back());
  world_.exchange<Lanes>(sums, sums_to_, of_groups, sums_from_);
  std::vector<Lanes> groups(groups_.count(world_.rank()), Lanes{});
  for (std::size_t i = 0; i < of_groups.size(); ++i) add(groups[i / TallyTotal::kGroup], of_groups[i]);
  Lanes total{};
  for (const Lanes& group : world_.gather(groups)) add(total, group);
  world_.broadcast(total, 0);
  return {(total[0] + total[1]) + (total[2] + total[3]), world_.sum(defined)};
}

Statistics SharedStatistics::of(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                std::span<const Index> immovable, ThreadPool* pool) const {
  const std::size_t count = share_->home.size();
  mine_.resize(to_.size());
  std::vector<Extremes> parts((count + kElementsAtOnce - 1) / kElementsAtOnce);
  for_chunks(pool, count, kElementsAtOnce, [&](std::size_t first, std::size_t last) {
    Extremes here;
    auto fixed = std::ranges::lower_bound(immovable, static_cast<Index>(first));
    auto counted = static_cast<std::size_t>(std::ranges::lower_bound(to_, static_cast<Index>(first)) - to_.begin());
    for_blocks(context, positions, metric, first, last, [&](const ElementBlock& block) {
      for (std::size_t i = 0; i < block.count; ++i) {
        const auto e = static_cast<Index>(block.first + i);
        const bool is_fixed = fixed != immovable.end() && *fixed == e;
        if (is_fixed) ++fixed;
        if (share_->home[e] == 0) continue;
        const double quality = block.quality[i];
        mine_[counted++] = quality;
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
  const Sum sum = sum_of_mine();
  const double mean = sum.count > 0 ? sum.sum / static_cast<double>(sum.count) : std::numeric_limits<double>::quiet_NaN();
  const Index worst = all.worst < kNoIndex ? static_cast<Index>(all.worst) : kNoIndex;
  return {all.minimum, mean, all.movable, all.ceiling, worst, static_cast<Index>(std::min<std::uint64_t>(all.inverted, kNoIndex))};
}

}  // namespace dmoscope
