#pragma once
// Text of others within one line of a file.

#include <string>

namespace dmoscope {

/// The text with blanks for control characters, line ends among them: what follows a title is not part of it.
[[nodiscard]] inline std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return text;
}

}  // namespace dmoscope
