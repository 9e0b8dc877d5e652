#include "mpi/smooth/shared_order.h"

#include <algorithm>
#include <bit>

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

}  // namespace dmoscope
