// Typing faster than frames are drawn: nothing is lost, nothing acts twice, and nothing typed into a field becomes a command.
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "tests/gui/headless_test.h"

namespace dmoscope::app {
namespace {

using ui::Dialog;
using ui::KeyChord;

/// Sends a letter as a keyboard does: press, character, release.
void strike(KeyQueue& keys, char c) {
  const int code = c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
  keys.press({code});
  keys.character(static_cast<char32_t>(c));
  keys.release(code);
}

void strike(KeyQueue& keys, const KeyChord& chord) {
  keys.press(chord);
  keys.release(chord.code);
}

class Typing : public HeadlessTest {
 protected:
  [[nodiscard]] KeyQueue& keys() { return window_->keys(); }
  void frames(int count) {
    for (int k = 0; k < count; ++k) window_->frame();
  }
  [[nodiscard]] std::uint64_t iteration() { return session()->frame->moment.iteration; }
  [[nodiscard]] std::string commands() {
    std::string all;
    for (const auto& line : state().commands.lines()) all += line.text + "\n";
    return all;
  }
};

TEST_F(Typing, ThreeHundredCharactersArriveInASlowWindowAndNothingElseHappens) {
  good("generate annulus");
  good("dialog export");
  good("click export:file");
  good("key Ctrl+A");
  const std::string before = commands();
  const std::string letters = "rbsnvcuh lmfwxdtq/gyzeopkaj.1234567890-_=[]";
  std::string typed;
  while (typed.size() < 300) typed += letters[typed.size() % letters.size()];
  const auto camera = state().camera;
  for (std::size_t k = 0; k < typed.size(); k += 10) {  // 50 a second, five frames a second
    for (const char c : typed.substr(k, 10)) strike(keys(), c);
    window_->frame();
  }
  window_->settle();
  EXPECT_EQ(state().dialog, Dialog::Export);
  EXPECT_EQ(iteration(), 0U);
  EXPECT_EQ(commands(), before);
  EXPECT_EQ(state().camera.units_per_pixel, camera.units_per_pixel);
  good("key Ctrl+A");
  good("key Ctrl+C");
  EXPECT_EQ(window_->clipboard(), typed);
}

TEST_F(Typing, WhatIsTypedBehindEnterInADialogIsNoCommand) {
  good("generate annulus");
  good("step iteration 3");
  good("key Ctrl+F");
  ASSERT_EQ(state().dialog, Dialog::Find);
  strike(keys(), '7');
  strike(keys(), KeyChord{ui::key::kEnter});
  for (const char c : std::string("rsnw")) strike(keys(), c);  // all before the dialog was drawn as closed
  strike(keys(), KeyChord{ui::key::kLeft});
  window_->settle();
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 7}));
  EXPECT_EQ(iteration(), 3U);
  EXPECT_FALSE(state().brush.on);
  EXPECT_TRUE(state().wireframe);
  strike(keys(), 'w');  // now it is a command again
  window_->settle();
  EXPECT_FALSE(state().wireframe);
}

TEST_F(Typing, ModifiersAreThoseOfThePress) {
  good("generate annulus");
  const auto with_ctrl = [&](int letter) {
    keys().press({ui::key::kLeftControl, true});
    keys().press({letter, true});
    keys().release(ui::key::kLeftControl);  // released before the letter, and all within one frame
    keys().release(letter);
    window_->settle();
  };
  with_ctrl('P');
  EXPECT_EQ(state().dialog, Dialog::Palette);
  EXPECT_EQ(state().timeline.play.kind, ui::Playback::Kind::Off);
  good("key Escape");
  good("run 2");
  with_ctrl('Z');
  EXPECT_EQ(iteration(), 0U);
  with_ctrl('Y');
  EXPECT_EQ(iteration(), 2U);
  strike(keys(), 'n');  // without Ctrl, though it was held in the frame before
  window_->settle();
  EXPECT_EQ(iteration(), 3U);
}

TEST_F(Typing, NoKeyIsLostAndNoneActsTwice) {
  good("generate annulus");
  for (int k = 0; k < 5; ++k) strike(keys(), 'n');  // within one frame
  window_->settle();
  EXPECT_EQ(iteration(), 5U);
  keys().press({'N'});
  frames(200);  // still held for a window that was not told of its release
  keys().release('N');
  window_->settle();
  EXPECT_EQ(iteration(), 6U);
  keys().press({'W'});
  for (int k = 0; k < 4; ++k) keys().press({'W'}, true);  // repeated by the desktop
  keys().release('W');
  window_->settle();
  EXPECT_FALSE(state().wireframe);
}

TEST_F(Typing, WhatFollowsTheKeyOfADialogIsForItsField) {
  good("generate annulus");
  keys().press({'P', true});
  keys().release('P');
  for (const char c : std::string("step class 2")) strike(keys(), c);
  strike(keys(), KeyChord{ui::key::kEnter});
  window_->settle();
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_NE(commands().find("step class 2\n"), std::string::npos) << commands();
  EXPECT_EQ(state().picked, ui::Picked{});
}

TEST_F(Typing, EditingKeysKeepTheirPlaceAmongTheLetters) {
  good("generate annulus");
  good("key Ctrl+P");
  for (const char c : std::string("stepp")) strike(keys(), c);
  strike(keys(), KeyChord{ui::key::kBackspace});
  strike(keys(), ' ');
  for (const char c : std::string("clabb")) strike(keys(), c);
  strike(keys(), KeyChord{ui::key::kBackspace});
  strike(keys(), KeyChord{ui::key::kBackspace});
  for (const char c : std::string("ss")) strike(keys(), c);
  strike(keys(), KeyChord{ui::key::kHome});
  strike(keys(), KeyChord{ui::key::kDelete});
  strike(keys(), 's');
  window_->settle();
  good("key Ctrl+A");
  good("key Ctrl+C");
  EXPECT_EQ(window_->clipboard(), "step class");
}

TEST_F(Typing, TabMovesTheFocusWithARingAndEscapeEndsIt) {
  good("generate annulus");
  good("move 3 3");
  const auto before = state().commands.lines().size();
  good("key Tab");
  EXPECT_TRUE(ImGui::GetIO().NavVisible);
  const render::Image first = window_->picture();
  good("key Tab");
  EXPECT_NE(first.rgba, window_->picture().rgba);  // the ring has moved
  good("key Shift+Tab");
  EXPECT_EQ(first.rgba, window_->picture().rgba);
  EXPECT_EQ(state().commands.lines().size(), before);
  good("key Escape");
  EXPECT_FALSE(ImGui::GetIO().NavVisible);
  good("key N");
  EXPECT_EQ(iteration(), 1U);
  EXPECT_FALSE(ImGui::GetIO().NavVisible);  // a command brings no ring
  good("key Alt+A");
  EXPECT_FALSE(ImGui::GetIO().NavVisible);
}

TEST_F(Typing, EnterPressesTheControlWithTheRing) {
  good("generate annulus");
  bool pressed = false;
  for (int k = 0; k < 60 && !pressed; ++k) {
    good("key Tab");
    good("key Enter");
    pressed = iteration() != 0 || !state().wireframe;
    if (state().dialog != Dialog::None) good("dialog none");
    if (ImGui::GetIO().WantTextInput) good("key Escape");
    if (!ImGui::GetCurrentContext()->OpenPopupStack.empty()) good("key Escape");
  }
  EXPECT_TRUE(pressed);
}

TEST_F(Typing, AltAloneReachesTheMenus) {
  constexpr int kLeftAlt = ui::key::kLeftShift + 2;
  good("generate annulus");
  const auto frames = [&] {
    for (int k = 0; k < 4; ++k) window_->frame();
  };
  keys().press({kLeftAlt});
  frames();
  keys().release(kLeftAlt);
  frames();
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  EXPECT_EQ(g.NavLayer, ImGuiNavLayer_Menu);
  good("key Down");
  EXPECT_FALSE(g.OpenPopupStack.empty()) << "the first menu";
  good("key Escape");
  good("key Escape");
  EXPECT_TRUE(g.OpenPopupStack.empty());
  good("key N");
  EXPECT_EQ(iteration(), 1U) << "keys are commands again";
}

TEST_F(Typing, TabGoesThroughADialogAndStaysInIt) {
  good("generate annulus");
  good("dialog screenshot");
  for (int k = 0; k < 12; ++k) {
    good("key Tab");
    EXPECT_EQ(state().dialog, Dialog::Screenshot);
  }
  good("click screenshot:file");
  good("key Ctrl+A");
  good("type abc");
  good("key Tab");
  good("key Shift+Tab");
  good("type xyz");  // the whole text was selected
  good("key Ctrl+A");
  good("key Ctrl+C");
  EXPECT_EQ(window_->clipboard(), "xyz");
  EXPECT_EQ(iteration(), 0U);
}

TEST_F(Typing, SpacePressesTheControlThatHasTheRing) {
  good("generate annulus");
  bool pressed = false;
  for (int k = 0; k < 60 && !pressed; ++k) {
    good("key Tab");
    good("key Space");
    pressed = iteration() != 0 || state().dialog != Dialog::None || !state().wireframe;
    if (state().dialog != Dialog::None) good("dialog none");
    if (ImGui::GetIO().WantTextInput) good("key Escape");
  }
  EXPECT_TRUE(pressed);
}

}  // namespace
}  // namespace dmoscope::app
