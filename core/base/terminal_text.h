#pragma once
// Text of others (names, contents of files) for a terminal: it shows them, and obeys nothing in them.

#include <string>
#include <string_view>

namespace dmoscope {

/// The text with all that a terminal would obey or that would turn the reading direction written as \x1b or \u{202e}, bytes that are no
/// UTF-8 as \xff: control characters of both kinds, tabulators and line ends among them.
[[nodiscard]] std::string terminal_line(std::string_view text);

/// The same for several lines: line ends stay.
[[nodiscard]] std::string terminal_lines(std::string_view text);

}  // namespace dmoscope
