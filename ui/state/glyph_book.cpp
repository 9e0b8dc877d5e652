#include "ui/state/glyph_book.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/base/utf8.h"

namespace dmoscope::ui {
namespace {

/// Range of the stand-ins: Yi syllables, which hardly any file has; a file's own ones get stand-ins, too. ImGui takes no private letters
/// from a keyboard.
constexpr char32_t kStandInFirst = 0xA000, kStandInLast = 0xA48C, kLastOfPlane = 0xFFFF, kLastLatin = 0xFF;

bool is_stand_in(char32_t letter) { return letter >= kStandInFirst && letter <= kStandInLast; }

void append(std::string& text, char16_t letter) {
  const auto bits = static_cast<unsigned>(letter);
  if (bits < 0x80U) {
    text += static_cast<char>(bits);
  } else if (bits < 0x800U) {
    text += static_cast<char>(0xC0U | (bits >> 6U));
    text += static_cast<char>(0x80U | (bits & 0x3FU));
  } else {
    text += static_cast<char>(0xE0U | (bits >> 12U));
    text += static_cast<char>(0x80U | ((bits >> 6U) & 0x3FU));
    text += static_cast<char>(0x80U | (bits & 0x3FU));
  }
}

/// UTF-8 of a letter beyond U+FFFF.
std::string long_letter(char32_t letter) {
  const auto part = [letter](unsigned shift) { return static_cast<char>(0x80U | ((static_cast<unsigned>(letter) >> shift) & 0x3FU)); };
  return {static_cast<char>(0xF0U | (static_cast<unsigned>(letter) >> 18U)), part(12), part(6), part(0)};
}

bool plain(std::string_view text) {
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x80U) return false;
  }
  return true;
}

}  // namespace

std::string letter_name(char32_t letter) { return fmt::format("<U+{:04X}>", static_cast<std::uint32_t>(letter)); }
std::string byte_name(unsigned char byte) { return fmt::format("<0x{:02X}>", byte); }

char16_t GlyphBook::stand_in(const std::string& meant, const std::string& name) {
  const auto at = known_.find(meant);
  if (at != known_.end()) return at->second;
  const char32_t next = kStandInFirst + static_cast<char32_t>(stand_ins_.size());
  if (next > kStandInLast) return u'\xFFFD';
  const auto letter = static_cast<char16_t>(next);
  known_.emplace(meant, letter);
  stand_ins_.emplace(letter, StandIn{meant, name});
  return letter;
}

std::string GlyphBook::shown(std::string_view text) {
  if (plain(text)) return std::string(text);
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(text, code);
    if (size == 0) {
      append(out, stand_in(std::string(text.substr(0, 1)), byte_name(static_cast<unsigned char>(text.front()))));
    } else if (code > kLastOfPlane || is_stand_in(code)) {
      append(out, stand_in(std::string(text.substr(0, size)), letter_name(code)));
    } else {
      if (code > kLastLatin) letters_.insert(static_cast<char16_t>(code));
      out += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

std::string GlyphBook::meant(std::string_view shown) const {
  if (plain(shown)) return std::string(shown);
  std::string out;
  out.reserve(shown.size());
  while (!shown.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(shown, code);
    const auto at = size != 0 && is_stand_in(code) ? stand_ins_.find(static_cast<char16_t>(code)) : stand_ins_.end();
    out += at == stand_ins_.end() ? std::string(shown.substr(0, size == 0 ? 1 : size)) : at->second.meant;
    shown.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

char16_t GlyphBook::shown_letter(char32_t letter) {
  if (letter > kLastOfPlane) return stand_in(long_letter(letter), letter_name(letter));
  if (is_stand_in(letter)) {
    std::string meant;
    append(meant, static_cast<char16_t>(letter));
    return stand_in(meant, letter_name(letter));
  }
  if (letter > kLastLatin) letters_.insert(static_cast<char16_t>(letter));
  return static_cast<char16_t>(letter);
}

}  // namespace dmoscope::ui
