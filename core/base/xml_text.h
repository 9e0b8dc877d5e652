#pragma once
// Text inside XML, SVG and HTML.

#include <string>
#include <string_view>

namespace dmoscope {

/// Escapes the text for use between tags and within quotes. Control characters, which XML does not allow, are left out; bytes that are not
/// UTF-8 become U+FFFD.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace dmoscope
