#include "core/base/terminal_text.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/base/utf8.h"

namespace dmoscope {
namespace {

bool turns_direction(std::uint32_t code) {
  return code == 0x61C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string escaped(std::string_view text, bool keep_line_ends) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(text, code);
    if (size == 0 || code < 0x20 || code == 0x7F) {
      const auto byte = static_cast<unsigned char>(text.front());
      out += keep_line_ends && byte == '\n' ? std::string("\n") : fmt::format("\\x{:02x}", byte);
    } else if ((code >= 0x80 && code < 0xA0) || code == 0x2028 || code == 0x2029 || turns_direction(code)) {
      out += fmt::format("\\u{{{:x}}}", code);
    } else {
      out += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

}  // namespace

std::string terminal_line(std::string_view text) { return escaped(text, false); }

std::string terminal_lines(std::string_view text) { return escaped(text, true); }

}  // namespace dmoscope
