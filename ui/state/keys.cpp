#include "ui/state/keys.h"

#include <array>
#include <utility>

namespace dmoscope::ui {
namespace {

constexpr std::array<std::pair<std::string_view, int>, 15> kNamed{{{"Space", key::kSpace},
                                                                   {"Escape", key::kEscape},
                                                                   {"Enter", key::kEnter},
                                                                   {"Tab", key::kTab},
                                                                   {"Backspace", key::kBackspace},
                                                                   {"Insert", key::kInsert},
                                                                   {"Delete", key::kDelete},
                                                                   {"Right", key::kRight},
                                                                   {"Left", key::kLeft},
                                                                   {"Down", key::kDown},
                                                                   {"Up", key::kUp},
                                                                   {"PageUp", key::kPageUp},
                                                                   {"PageDown", key::kPageDown},
                                                                   {"Home", key::kHome},
                                                                   {"End", key::kEnd}}};

std::optional<int> parse_code(std::string_view name) {
  for (const auto& [word, code] : kNamed) {
    if (word == name) return code;
  }
  if (name.size() == 1) {
    const char c = name[0];
    if (c >= 'a' && c <= 'z') return c - 'a' + 'A';
    if (c > ' ' && c < 0x7f) return c;
  }
  if (name.size() >= 2 && name.size() <= 3 && name[0] == 'F') {
    int number = 0;
    for (const char c : name.substr(1)) {
      if (c < '0' || c > '9') return std::nullopt;
      number = 10 * number + (c - '0');
    }
    if (number >= 1 && number <= 12) return key::kF1 + number - 1;
  }
  return std::nullopt;
}

}  // namespace

std::optional<KeyChord> parse_key(std::string_view name) {
  KeyChord chord;
  const auto take = [&name](std::string_view prefix) {
    if (!name.starts_with(prefix) || name.size() == prefix.size()) return false;
    name.remove_prefix(prefix.size());
    return true;
  };
  for (bool again = true; again;) {
    again = false;
    if (take("Ctrl+")) again = chord.ctrl = true;
    if (take("Shift+")) again = chord.shift = true;
    if (take("Alt+")) again = chord.alt = true;
  }
  const std::optional<int> code = parse_code(name);
  if (!code) return std::nullopt;
  chord.code = *code;
  return chord;
}

std::string key_name(const KeyChord& chord) {
  std::string text;
  if (chord.ctrl) text += "Ctrl+";
  if (chord.shift) text += "Shift+";
  if (chord.alt) text += "Alt+";
  for (const auto& [word, code] : kNamed) {
    if (code == chord.code) return text.append(word);
  }
  if (chord.code >= key::kF1 && chord.code < key::kF1 + 12) return text + "F" + std::to_string(chord.code - key::kF1 + 1);
  return text + static_cast<char>(chord.code);
}

}  // namespace dmoscope::ui
