#pragma once
// Letters in UTF-8.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmoscope {

/// Decodes the first letter of `text`, which is not empty, into `code`; returns its number of bytes, 0: it is not UTF-8.
[[nodiscard]] inline std::size_t utf8_letter(std::string_view text, std::uint32_t& code) noexcept {
  const auto bits = [&text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = bits(0);
  code = first;
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : first >= 0xF0 && first < 0xF5 ? 4 : 0;
  if (size == 0 || size > text.size()) return 0;
  code = first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((bits(i) & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (bits(i) & 0x3FU);
  }
  const bool too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool no_letter = (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF;
  return too_long || no_letter ? 0 : size;
}

}  // namespace dmoscope
