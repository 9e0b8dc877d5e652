#pragma once
// Text of others (names, contents of files) for a terminal: it shows them, and obeys nothing in them.

#include <string>
#include <string_view>

namespace dmoscope {

/// The text with control characters (tabs and line ends too) and marks that turn the reading direction written as \x1b or \u{202e}, and
/// bytes that are not UTF-8 as \xff.
[[nodiscard]] std::string terminal_line(std::string_view text);

/// The same for several lines: line ends stay.
[[nodiscard]] std::string terminal_lines(std::string_view text);

}  // namespace dmoscope
