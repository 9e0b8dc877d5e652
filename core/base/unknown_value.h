#pragma once
// Messages about words that the program does not know.

#include <algorithm>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace dmoscope {

/// The known word that `word` was most likely meant to be: at most one letter in four is wrong, missing, extra or swapped with its
/// neighbour; case does not matter. None if no word is that close, or several are equally close.
[[nodiscard]] std::optional<std::string_view> closest_word(std::string_view word, std::span<const std::string_view> known);

/// Message "unknown metric 'skewness'; known are mean-ratio, min-angle", with "; did you mean mean-ratio?" if one of them is close.
[[nodiscard]] std::string unknown_value(std::string_view kind, std::string_view word, std::span<const std::string_view> known);

/// The value of an enumeration whose words are `words`, in its order. Throws Problem for another word.
template <class Enum, class Problem = UsageError>
[[nodiscard]] Enum parse_choice(std::string_view kind, std::string_view word, std::span<const std::string_view> words) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) throw Problem(unknown_value(kind, word, words));
  return static_cast<Enum>(found - words.begin());
}

/// Message of unknown_value() with the names of a table's rows.
template <std::ranges::input_range Table>
[[nodiscard]] std::string unknown_row(std::string_view kind, std::string_view word, const Table& table) {
  std::vector<std::string_view> names;
  for (const auto& row : table) names.push_back(row.name);
  return unknown_value(kind, word, names);
}

}  // namespace dmoscope
