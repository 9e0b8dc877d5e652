#include "core/base/words.h"

#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace dmoscope {

std::vector<std::string> split_words(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  bool in_word = false, quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c == '"')
        quoted = false;
      else if (c == '\\' && i + 1 < line.size() && (line[i + 1] == '"' || line[i + 1] == '\\'))
        word += line[++i];
      else
        word += c;
    } else if (c == '"') {
      quoted = in_word = true;
    } else if (c == '#' && !in_word) {
      break;
    } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      if (in_word) words.push_back(std::exchange(word, {}));
      in_word = false;
    } else {
      in_word = true;
      word += c;
    }
  }
  if (quoted) throw UsageError("a double quote is never closed");
  if (in_word) words.push_back(std::move(word));
  return words;
}

std::string quote_word(std::string_view word) {
  if (!word.empty() && word.find_first_of(" \t\r\n\"\\#") == std::string_view::npos) return std::string(word);
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

void require(Arguments arguments, std::size_t least, std::size_t most) {
  if (arguments.size() < least) throw WrongArguments("too few arguments");
  if (arguments.size() > most) throw WrongArguments(fmt::format("'{}' is one argument too many", arguments[most]));
}

std::uint64_t to_count(const std::string& word, std::uint64_t least) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value < least)
    throw WrongArguments(fmt::format("'{}' is not a whole number of at least {}", word, least));
  return value;
}

double to_number(const std::string& word) {
  double value = 0.0;
  const std::size_t sign = word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0;  // a plus sign, which from_chars does not accept
  const auto [end, error] = std::from_chars(word.data() + sign, word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    throw WrongArguments(fmt::format("'{}' is not a number", word));
  return value;
}

}  // namespace dmoscope
