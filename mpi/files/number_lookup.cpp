#include "mpi/files/number_lookup.h"

#include <algorithm>

namespace dmoscope {

namespace {

struct Numbered {
  std::int64_t number;
  std::uint64_t thing;
  friend auto operator<=>(const Numbered&, const Numbered&) = default;
};

/// The rank that keeps the answers about a number.
int keeper(std::int64_t number, int ranks) {
  const std::uint64_t mixed = static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15U;
  return static_cast<int>((mixed >> 32U) % static_cast<std::uint64_t>(ranks));
}

}  // namespace

NumberLookup look_up_numbers(const World& world, std::span<const std::int64_t> numbers, std::uint64_t first,
                             std::span<const std::int64_t> asked) {
  Dealer<Numbered> known(world.size());
  for (const std::int64_t number : numbers) known.count(keeper(number, world.size()));
  known.begin();
  for (std::size_t i = 0; i < numbers.size(); ++i) known.put(keeper(numbers[i], world.size()), {numbers[i], first + i});
  std::vector<Numbered> kept = world.exchange(known.take()).values;
  std::ranges::sort(kept);
  NumberLookup lookup;
  for (std::size_t i = 1; i < kept.size(); ++i)
    if (kept[i].number == kept[i - 1].number) lookup.twice = std::min(lookup.twice, kept[i].thing);
  lookup.twice = world.least(lookup.twice);

  Dealer<std::int64_t> questions(world.size());
  for (const std::int64_t number : asked) questions.count(keeper(number, world.size()));
  questions.begin();
  std::vector<std::uint64_t> place(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) place[i] = questions.put(keeper(asked[i], world.size()), asked[i]);
  const Parts<std::int64_t> here = world.exchange(questions.parts());
  std::vector<std::uint64_t> answers;
  answers.reserve(here.values.size());
  for (const std::int64_t number : here.values) {
    const auto at = std::ranges::lower_bound(kept, number, {}, &Numbered::number);
    answers.push_back(at != kept.end() && at->number == number ? at->thing : NumberLookup::kNone);
  }
  std::vector<std::uint64_t> back(asked.size());
  world.exchange<std::uint64_t>(answers, here.offsets, back, questions.parts().offsets);
  for (const std::uint64_t at : place) lookup.found.push_back(back[at]);
  return lookup;
}

}  // namespace dmoscope
