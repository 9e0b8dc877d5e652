#include "core/base/xml_text.h"

#include <cstddef>
#include <cstdint>

#include "core/base/utf8.h"

namespace dmoscope {

std::string xml_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    std::uint32_t code = 0;
    std::size_t size = utf8_letter(text, code);
    if (code == 0xFFFE || code == 0xFFFF) size = 0;  // not allowed in XML
    const char c = text[0];
    if (size == 0) {
      out += "\xEF\xBF\xBD";
    } else if (size > 1) {
      out += text.substr(0, size);
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else if (code >= 0x20 && code != 0x7F) {
      out += c;
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

}  // namespace dmoscope
