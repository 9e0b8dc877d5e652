#pragma once
// Letters that the interface's fonts may lack: names of files and groups may have any letter.

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dmoscope::ui {

/// Name of a letter, "<U+4E2D>", or of a byte that is not UTF-8, "<0xE9>".
[[nodiscard]] std::string letter_name(char32_t letter);
[[nodiscard]] std::string byte_name(unsigned char byte);

/// Notes the letters in texts from files, so that the fonts can be built with them. Each letter that ImGui cannot take at all (beyond
/// U+FFFF, or a byte that is not UTF-8) is shown by a stand-in of its own, so that the text can be edited in a field and read back
/// unchanged.
class GlyphBook {
 public:
  /// The text as ImGui shows it.
  [[nodiscard]] std::string shown(std::string_view text);
  /// The reverse of shown(), also for a text that a person edited since.
  [[nodiscard]] std::string meant(std::string_view shown) const;
  /// The stand-in, or the letter itself, for a letter that is typed.
  [[nodiscard]] char16_t shown_letter(char32_t letter);

  /// Letters other than Latin ones, in the form that is shown.
  [[nodiscard]] const std::set<char16_t>& letters() const noexcept { return letters_; }
  struct StandIn {
    std::string meant, name;
  };
  [[nodiscard]] const std::map<char16_t, StandIn>& stand_ins() const noexcept { return stand_ins_; }
  /// Number of letters and stand-ins noted; it only grows.
  [[nodiscard]] std::size_t size() const noexcept { return letters_.size() + stand_ins_.size(); }

 private:
  [[nodiscard]] char16_t stand_in(const std::string& meant, const std::string& name);

  std::set<char16_t> letters_;
  std::map<char16_t, StandIn> stand_ins_;
  std::map<std::string, char16_t, std::less<>> known_;  // stand-in of each letter meant
};

}  // namespace dmoscope::ui
