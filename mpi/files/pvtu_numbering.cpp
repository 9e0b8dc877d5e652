#include "mpi/files/pvtu_numbering.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace dmoscope {
namespace {

/// Sends each rank's keys to their keepers, and the keepers' answers back.
template <Plain Key>
class Keepers {
 public:
  template <class KeeperOf>
  Keepers(const World& world, std::span<const Key> keys, const KeeperOf& keeper_of) : world_(world) {
    Dealer<Key> dealer(world.size());
    for (const Key& key : keys) dealer.count(keeper_of(key));
    dealer.begin();
    place_.reserve(keys.size());
    for (const Key& key : keys) place_.push_back(dealer.put(keeper_of(key), key));
    offsets_ = dealer.parts().offsets;
    kept_ = world.exchange(dealer.take());
  }
  /// Keys that arrived, in the order of the ranks and of their things.
  [[nodiscard]] const std::vector<Key>& kept() const noexcept { return kept_.values; }
  /// Sends answers back to each rank and returns those for this rank's things, by thing. `answers`: one for each of kept().
  template <Plain Answer>
  [[nodiscard]] std::vector<Answer> give_back(const std::vector<Answer>& answers) const {
    std::vector<Answer> back(place_.size()), in_order;
    world_.exchange<Answer>(answers, kept_.offsets, back, offsets_);
    in_order.reserve(place_.size());
    for (const std::uint64_t at : place_) in_order.push_back(back[at]);
    return in_order;
  }
  /// Sends other values of the things to the keys' keepers. `values`: one a thing. Returns those that arrived, in the order of kept().
  template <Plain Value>
  [[nodiscard]] std::vector<Value> take_along(const std::vector<Value>& values) const {
    std::vector<Value> to(place_.size()), there(kept_.values.size());
    for (std::size_t i = 0; i < values.size(); ++i) to[place_[i]] = values[i];
    world_.exchange<Value>(to, offsets_, there, kept_.offsets);
    return there;
  }

 private:
  const World& world_;
  std::vector<std::uint64_t> place_, offsets_;
  Parts<Key> kept_;
};

/// Finds for each of `keys` the least place of an equal one.
template <class Key>
std::vector<std::uint64_t> first_of_equals(const std::vector<Key>& keys) {
  std::vector<std::uint64_t> order(keys.size()), first(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::uint64_t a, std::uint64_t b) { return keys[a] < keys[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

}  // namespace

SharedNumbers number_by_id(const World& world, std::span<const std::uint64_t> ids) {
  std::uint64_t most = 0;
  for (const std::uint64_t id : ids) most = std::max(most, id);
  const Ranges space(world.greatest(most) + 1, world.size());
  const Keepers<std::uint64_t> keepers(world, ids, [&](std::uint64_t id) { return space.holder(id); });
  const std::vector<std::uint64_t>& kept = keepers.kept();
  const std::vector<std::uint64_t> first = first_of_equals(kept);
  std::vector<std::uint64_t> order;  // first things of an id
  for (std::uint64_t i = 0; i < kept.size(); ++i)
    if (first[i] == i) order.push_back(i);
  std::ranges::sort(order, {}, [&](std::uint64_t i) { return kept[i]; });
  SharedNumbers numbers;
  numbers.ranges = world.ranges(order.size());
  struct Answer {
    WholeIndex number;
    std::uint64_t first;
  };
  std::vector<Answer> answers(kept.size());
  for (std::size_t k = 0; k < order.size(); ++k) answers[order[k]] = {numbers.ranges.begin(world.rank()) + k, 1};
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (first[i] != i) answers[i] = {answers[first[i]].number, 0};
  for (const Answer& answer : keepers.give_back(answers)) {
    numbers.of_thing.push_back(answer.number);
    numbers.first.push_back(static_cast<std::uint8_t>(answer.first));
  }
  return numbers;
}

SharedNumbers number_by_place(const World& world, std::span<const Vec3> places) {
  using Bits = std::array<std::uint64_t, 3>;
  std::vector<Bits> keys;
  keys.reserve(places.size());
  for (const Vec3& p : places)
    keys.push_back({std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)});
  const Keepers<Bits> keepers(world, keys, [&](const Bits& bits) {
    std::uint64_t mixed = 0;
    for (const std::uint64_t b : bits) mixed = (mixed ^ b ^ (mixed >> 29U)) * 0x9e3779b97f4a7c15U;
    return static_cast<int>((mixed >> 32U) % static_cast<std::uint64_t>(world.size()));
  });
  const std::vector<std::uint64_t> first = first_of_equals(keepers.kept());
  std::vector<std::uint8_t> is_first(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) is_first[i] = first[i] == i ? 1 : 0;
  SharedNumbers numbers;
  numbers.first = keepers.give_back(is_first);
  const auto count = static_cast<std::uint64_t>(std::ranges::count(numbers.first, std::uint8_t{1}));
  numbers.ranges = world.ranges(count);
  // The first things know their numbers, and tell the keepers, who tell the others.
  std::vector<WholeIndex> told(places.size(), 0);
  WholeIndex next = numbers.ranges.begin(world.rank());
  for (std::size_t i = 0; i < told.size(); ++i)
    if (numbers.first[i] != 0) told[i] = next++;
  std::vector<WholeIndex> answers = keepers.take_along(told);
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = answers[first[i]];
  numbers.of_thing = keepers.give_back(answers);
  return numbers;
}

}  // namespace dmoscope
