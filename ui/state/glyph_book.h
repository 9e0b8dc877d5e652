#pragma once
// Letters that the interface's fonts may lack: names of files and groups have any.

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dmoscope::ui {

/// "<U+4E2D>", and of a byte that is no UTF-8 "<0xE9>".
[[nodiscard]] std::string letter_name(char32_t letter);
[[nodiscard]] std::string byte_name(unsigned char byte);

/// Notes what letters there are in texts of others, for the fonts to be built with them. What ImGui cannot take at all (letters beyond
/// U+FFFF, bytes that are no UTF-8) is shown by a stand-in, one each, so that it can be edited in a field and read
/// back as it was.
class GlyphBook {
 public:
  /// The text for ImGui.
  [[nodiscard]] std::string shown(std::string_view text);
  /// What shown() made of a text, or a person of that, back as it was.
  [[nodiscard]] std::string meant(std::string_view shown) const;
  /// For a letter that is typed.
  [[nodiscard]] char16_t shown_letter(char32_t letter);

  /// Letters as they are written that are no Latin ones.
  [[nodiscard]] const std::set<char16_t>& letters() const noexcept { return letters_; }
  struct StandIn {
    std::string meant, name;
  };
  [[nodiscard]] const std::map<char16_t, StandIn>& stand_ins() const noexcept { return stand_ins_; }
  /// Grows with both.
  [[nodiscard]] std::size_t size() const noexcept { return letters_.size() + stand_ins_.size(); }

 private:
  [[nodiscard]] char16_t stand_in(const std::string& meant, const std::string& name);

  std::set<char16_t> letters_;
  std::map<char16_t, StandIn> stand_ins_;
  std::map<std::string, char16_t, std::less<>> known_;  // by what is meant
};

}  // namespace dmoscope::ui
