#pragma once
// Sorting large arrays by small keys.

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/memory.h"

namespace dmoscope {

/// Sorts items by `key(item)`, an unsigned number of at most `bits` bits; stably, digit by digit. Needs as much memory again.
template <class Item, class Key>
void radix_sort(std::vector<Item>& items, unsigned bits, const Key& key) {
  constexpr unsigned kDigit = 11, kDigits = 1U << kDigit;
  std::vector<Item> other = large_vector<Item>(items.size());
  for (unsigned shift = 0; shift < bits; shift += kDigit) {
    std::array<std::size_t, kDigits> next{};
    const auto digit = [shift, &key](const Item& item) { return key(item) >> shift & (kDigits - 1U); };
    for (const Item& item : items) ++next[digit(item)];
    std::size_t sum = 0;
    for (std::size_t& count : next) sum += std::exchange(count, sum);
    for (const Item& item : items) other[next[digit(item)]++] = item;
    items.swap(other);
  }
}

}  // namespace dmoscope
