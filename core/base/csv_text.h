#pragma once
// Words in a CSV (RFC 4180).

#include <string>
#include <string_view>

namespace dmoscope {

/// The word as the content of a cell, in quotes if necessary.
[[nodiscard]] inline std::string csv_text(std::string_view word) {
  if (word.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(word);
  std::string out = "\"";
  for (const char c : word) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace dmoscope
