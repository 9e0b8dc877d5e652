// Every letter that the program prints is in its fonts; letters of files are shown by fonts that have them, or by name.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "core/base/utf8.h"
#include "core/commands/session_commands.h"
#include "core/quality/metric.h"
#include "core/run/parameters.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/view_commands.h"
#include "ui/state/actions.h"
#include "ui/state/glyph_book.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;

using Letters = std::map<std::uint32_t, std::string>;  // letters, with the place of their first use

void collect(std::string_view text, const std::string& where, Letters& out) {
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(text, code);
    if (size != 0 && code >= 0x80) out.emplace(code, where);
    text.remove_prefix(size == 0 ? 1 : size);
  }
}

/// The string literals of a source; comments are left out.
std::string literals(std::string_view source) {
  std::string out;
  bool inside = false;
  for (std::size_t k = 0; k < source.size(); ++k) {
    if (!inside && source.substr(k).starts_with("//")) {
      k = std::min(source.find('\n', k), source.size() - 1);
    } else if (!inside && source[k] == '\'' && k + 2 < source.size()) {
      k = source.find('\'', source[k + 1] == '\\' ? k + 3 : k + 2);
      if (k == std::string_view::npos) break;
    } else if (source[k] == '\\' && inside) {
      ++k;
    } else if (source[k] == '"') {
      inside = !inside;
    } else if (inside) {
      out += source[k];
    }
  }
  return out;
}

class LettersShown : public HeadlessTest {
 protected:
  void expect_in_all_fonts(const Letters& letters) {
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts) {
      for (const auto& [letter, where] : letters)
        EXPECT_TRUE(letter <= 0xffff && font->FindGlyphNoFallback(static_cast<ImWchar>(letter)) != nullptr)
            << fmt::format("U+{:04X} of {}", letter, where);
    }
  }
};

TEST_F(LettersShown, AllOfEveryTable) {
  Letters letters;
  for (const MetricInfo& metric : metric_table()) {
    for (const std::string_view text : {metric.title, metric.formula, metric.doc}) collect(text, std::string(metric.name), letters);
  }
  for (const auto& parameter : parameter_table()) {
    collect(parameter.doc, std::string(parameter.name), letters);
  }
  for (const ui::Action& action : ui::actions()) collect(action.title, std::string(action.id), letters);
  for (const CommandInfo& command : session_commands()) collect(command.usage + command.doc, command.name, letters);
  for (const CommandInfo& command : ui::view_command_infos()) collect(command.usage + command.doc, command.name, letters);
  EXPECT_TRUE(letters.contains(0x1d62));  // used by formulas
  EXPECT_TRUE(letters.contains(0x2154));
  expect_in_all_fonts(letters);
}

TEST_F(LettersShown, AllOfEveryString) {
  Letters letters;
  for (const char* room : {"ui", "core", "app", "render", "gpu"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(DMOSCOPE_SOURCE_DIR) / room)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".h") continue;
      std::ifstream file(entry.path());
      std::ostringstream text;
      text << file.rdbuf();
      collect(literals(text.str()), entry.path().string(), letters);
    }
  }
  EXPECT_TRUE(letters.contains(0x275a));  // used by the button that pauses
  EXPECT_GT(letters.size(), 20U);
  expect_in_all_fonts(letters);
}

constexpr const char* kNames[] = {"网格中文", "شبكة", "mesh😀", "сетка", "maille\xe9", "メッシュ", "그물", "जाल", "\xf0\x90\x8d\x88"};

TEST_F(LettersShown, NamesOfFilesWhateverTheirLetters) {
  const test::TemporaryFolder folder;
  for (const char* name : kNames) {
    SCOPED_TRACE(name);
    const fs::path file = folder.path() / (std::string(name) + ".off");
    good("generate annulus");
    good("export \"" + file.string() + "\"");
    good("open \"" + file.string() + "\"");
    ASSERT_EQ(session()->input->path, file);
    ui::GlyphBook book;
    const std::string shown = book.shown(file.filename().string());
    EXPECT_EQ(book.meant(shown), file.filename().string());
    Letters letters;
    collect(shown, name, letters);
    expect_in_all_fonts(letters);
    EXPECT_NE(window_->app().title().find(name), std::string::npos);
    // The field keeps the letters through an edit.
    good("dialog export");
    good("click export:file");
    good("key End");
    good("key Backspace");
    good("key Backspace");
    good("key Backspace");
    good("type bj");
    good("key Backspace");
    good("key Backspace");
    good("type obj");
    good("key Enter");
    EXPECT_TRUE(fs::exists(folder.path() / (std::string(name) + "-smoothed.obj")));
    good("dialog open");
    EXPECT_TRUE(window_->app().items().boxes().contains("entry:" + std::string(name) + ".off"));
    good("dialog none");
    (void)window_->run("open \"" + (folder.path() / (std::string(name) + "-not.off")).string() + "\"");
    EXPECT_EQ(state().dialog, ui::Dialog::Error);
    good("key Escape");
  }
}

TEST_F(LettersShown, TypedOnesArriveInTheName) {
  const test::TemporaryFolder folder;
  good("generate annulus");
  good("dialog export");
  good("click export:file");
  good("key Ctrl+A");
  good("type \"" + (folder.path() / "网😀ꀀ.off").string() + "\"");
  good("key Enter");
  EXPECT_TRUE(fs::exists(folder.path() / "网😀ꀀ.off"));
}

TEST(GlyphBook, StandInsAreReadBackAsTheyWere) {
  ui::GlyphBook book;
  const std::string text = "a\xff😀b\xc3\xa9\ua000😀中";
  const std::string shown = book.shown(text);
  EXPECT_EQ(book.meant(shown), text);
  EXPECT_EQ(book.stand_ins().size(), 3U);  // the byte, the face, and the letter that stands in
  EXPECT_EQ(book.letters(), (std::set<char16_t>{u'中'}));
  EXPECT_EQ(book.shown("plain"), "plain");
  EXPECT_EQ(ui::letter_name(U'中'), "<U+4E2D>");
  EXPECT_EQ(ui::byte_name(0xff), "<0xFF>");
  const char16_t typed = book.shown_letter(U'😀');
  EXPECT_EQ(book.stand_ins().at(typed).name, "<U+1F600>");
}

TEST_F(LettersShown, ANameTakesTheRoomOfItsWords) {
  const std::string text = "\xea\x80\x80";  // the first stand-in
  good("generate annulus");
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "😀.off";
  good("export \"" + file.string() + "\"");
  good("open \"" + file.string() + "\"");
  const float wide = ImGui::GetIO().Fonts->Fonts[0]->CalcTextSizeA(15, 1e9F, 0, text.c_str()).x;
  const float words = ImGui::GetIO().Fonts->Fonts[0]->CalcTextSizeA(15, 1e9F, 0, "<U+1F600>").x;
  EXPECT_NEAR(wide, words, 4.0F);
}

}  // namespace
}  // namespace dmoscope::app
