#pragma once
// Keys by name ("Ctrl+Shift+S"), in the form that the actions table, scripts and the list of keys use.

#include <optional>
#include <string>
#include <string_view>

namespace dmoscope::ui {

/// A key with its modifiers. `code` has GLFW's numbering (printable keys are their upper-case ASCII code), which the event loop
/// and the headless driver both use.
struct KeyChord {
  int code = 0;
  bool ctrl = false, shift = false, alt = false;
  friend bool operator==(const KeyChord&, const KeyChord&) = default;
};

/// Codes of the keys that have no character.
namespace key {
inline constexpr int kSpace = 32, kEscape = 256, kEnter = 257, kTab = 258, kBackspace = 259, kInsert = 260, kDelete = 261, kRight = 262,
                     kLeft = 263, kDown = 264, kUp = 265, kPageUp = 266, kPageDown = 267, kHome = 268, kEnd = 269, kF1 = 290,
                     kLeftShift = 340, kLeftControl = 341, kLeftAlt = 342;
}  // namespace key

/// Key of a name such as "N", "Shift+C", "Ctrl+=", "Space" or "F11". None for a name that is no key.
[[nodiscard]] std::optional<KeyChord> parse_key(std::string_view name);

/// Name of a key, which parse_key reads back.
[[nodiscard]] std::string key_name(const KeyChord& chord);

}  // namespace dmoscope::ui
