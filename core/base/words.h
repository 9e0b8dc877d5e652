#pragma once
// Splitting of commands and descriptions into words, and conversion of words to numbers.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace dmoscope {

/// Splits a command line into words at blanks; "double quotes" keep blanks, \" and \\ inside them; # starts a comment. Throws UsageError
/// for an open quote.
[[nodiscard]] std::vector<std::string> split_words(std::string_view line);
/// Quotes a word if split_words would need quotes.
[[nodiscard]] std::string quote_word(std::string_view word);

/// Wrong number or form of a command's arguments; CommandTable::execute adds the command's usage.
class WrongArguments : public UsageError {
 public:
  using UsageError::UsageError;
};

/// The words after a command's name.
using Arguments = std::span<const std::string>;
/// Throws WrongArguments unless there are `least` to `most` arguments.
void require(Arguments arguments, std::size_t least, std::size_t most);
/// Conversions of words; all throw WrongArguments naming the word and what was expected.
[[nodiscard]] std::uint64_t to_count(const std::string& word, std::uint64_t least = 0);
[[nodiscard]] double to_number(const std::string& word);

}  // namespace dmoscope
