#pragma once
// Foreign text within one line of a file.

#include <algorithm>
#include <string>

namespace dmoscope {

/// The text with blanks for control characters, line ends among them, so that a title ends with its line.
[[nodiscard]] inline std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

/// The text with blanks for line ends only.
[[nodiscard]] inline std::string without_line_ends(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// The text for use between double quotes: a blank for each control character, single quotes for double ones.
[[nodiscard]] inline std::string in_quotes(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  std::ranges::replace(text, '"', '\'');
  return text;
}

}  // namespace dmoscope
