#include "core/base/unknown_value.h"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dmoscope {
namespace {

bool same_letter(char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); }

/// Edit distance of two words: letters inserted, deleted, replaced or swapped with their neighbour (optimal string alignment).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = now;
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string_view> closest_word(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t kLongest = 64;  // longer words are no typing errors
  if (word.size() > kLongest) return std::nullopt;
  std::size_t least = word.size() / 4 + 1;  // one more than allowed
  std::vector<std::string_view> closest;
  for (const std::string_view candidate : known) {
    const std::size_t edits = edits_between(word, candidate);
    if (edits > word.size() / 4 || edits > least) continue;
    if (edits < least) closest.clear();
    least = edits;
    closest.push_back(candidate);
  }
  return closest.size() == 1 ? std::optional(closest.front()) : std::nullopt;
}

std::string unknown_value(std::string_view kind, std::string_view word, std::span<const std::string_view> known) {
  const auto guess = closest_word(word, known);
  return fmt::format("unknown {} '{}'; known are {}{}", kind, word, fmt::join(known, ", "),
                     guess ? fmt::format("; did you mean {}?", *guess) : std::string());
}

}  // namespace dmoscope
