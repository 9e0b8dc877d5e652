#pragma once
// Text inside XML, SVG and HTML.

#include <string>
#include <string_view>

namespace dmoscope {

/// The text with what has a meaning in markup written as entities, between tags and within quotes alike; control characters, which XML does
/// not have, are left out, and bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace dmoscope
