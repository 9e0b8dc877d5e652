#pragma once
// Foreign text (names, contents of files) for a terminal, which shows it and obeys nothing in it.

#include <string>
#include <string_view>

namespace dmoscope {

/// The text with control characters (tabs and line ends too) and marks that change the reading direction written as \x1b or \u{202e}, and
/// bytes that are not UTF-8 as \xff.
[[nodiscard]] std::string terminal_line(std::string_view text);

/// Several lines of text, written like terminal_line(), but with their line ends.
[[nodiscard]] std::string terminal_lines(std::string_view text);

}  // namespace dmoscope
