// Unsaved work is marked, and nobody gives it up by mistake.
#include "ui/state/unsaved.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::app {
namespace {

class Unsaved : public HeadlessTest {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string title() { return window_->app().title(); }
  void begin() {
    good("generate coast 300");
    good("ask-unsaved on");
  }
  void type_name(const std::string& field, const std::string& name) {
    good("click " + field);
    good("key Ctrl+A");
    good("type \"" + name + "\"");
  }
  const test::TemporaryFolder folder_;
};

TEST_F(Unsaved, TheTitleTellsIt) {
  good("generate coast 300");
  const std::string plain = title();
  EXPECT_EQ(plain.find("•"), std::string::npos) << plain;
  good("step vertex");
  EXPECT_EQ(title(), "• " + plain);
  good("undo");
  EXPECT_EQ(title(), plain);
  good("run 2");
  EXPECT_EQ(title(), "• " + plain);
  good("save-session " + file("a.dmoscope"));
  EXPECT_EQ(title(), plain);
  good("step iteration");
  EXPECT_EQ(title(), "• " + plain);
  good("export " + file("a.off"));
  EXPECT_EQ(title(), plain);
  good("reset");
  EXPECT_EQ(title(), plain);
}

TEST_F(Unsaved, QuitAsksAndEscapeStays) {
  begin();
  good("run 2");
  good("key Ctrl+Q");
  EXPECT_EQ(state().dialog, ui::Dialog::Unsaved);
  EXPECT_FALSE(window_->quit());
  good("key Escape");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  EXPECT_FALSE(state().leaving.has_value());
  EXPECT_FALSE(window_->quit());
  good("key Ctrl+Q");
  good("click unsaved:cancel");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  EXPECT_FALSE(window_->quit());
  good("key Ctrl+Q");
  good("click unsaved:discard");
  EXPECT_TRUE(window_->quit());
}

TEST_F(Unsaved, NothingIsAskedWhereNothingIsLost) {
  begin();
  good("run 2");
  good("reset");
  good("key Ctrl+Q");
  EXPECT_TRUE(window_->quit());
}

TEST_F(Unsaved, ScriptsAreNotAsked) {
  good("generate coast 300");
  good("run 2");
  good("generate annulus");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  good("run 1");
  good("ask-unsaved on");
  good("quit");  // by the command, not the key
  EXPECT_TRUE(window_->quit());
}

TEST_F(Unsaved, SavingTheSessionThenGoesOn) {
  begin();
  good("run 2");
  good("key Ctrl+Q");
  good("click unsaved:session");
  EXPECT_EQ(state().dialog, ui::Dialog::SaveSession);
  type_name("session:file", file("kept.dmoscope"));
  good("click session:go");
  EXPECT_TRUE(window_->quit());
  EXPECT_TRUE(std::filesystem::exists(file("kept.dmoscope")));
}

TEST_F(Unsaved, WhoDoesNotSaveAfterAllIsAskedAgain) {
  begin();
  good("run 2");
  good("key Ctrl+Q");
  good("click unsaved:export");
  EXPECT_EQ(state().dialog, ui::Dialog::Export);
  good("click dialog:close");
  EXPECT_EQ(state().dialog, ui::Dialog::Unsaved);
  EXPECT_FALSE(window_->quit());
}

TEST_F(Unsaved, AnotherMeshOverItAsksToo) {
  begin();
  good("run 2");
  std::ofstream(file("two.off")) << "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  window_->app().submit_by_person("open \"" + file("two.off") + "\"");
  window_->settle();
  EXPECT_EQ(state().dialog, ui::Dialog::Unsaved);
  EXPECT_GT(window_->app().frame()->vertex_count(), 4U);
  good("answer cancel");
  EXPECT_GT(window_->app().frame()->vertex_count(), 4U);
  window_->app().submit_by_person("open \"" + file("two.off") + "\"");
  window_->settle();
  good("answer discard");
  EXPECT_EQ(window_->app().frame()->vertex_count(), 4U);
  EXPECT_FALSE(window_->quit());
}

TEST_F(Unsaved, ARunThatGoesOnIsSaidAndStopsForTheAnswer) {
  begin();
  window_->app().submit("run 1000000");
  window_->frame();
  window_->app().submit_by_person("quit");
  EXPECT_EQ(state().dialog, ui::Dialog::Unsaved);
  ASSERT_TRUE(state().leaving.has_value());
  const auto question = ui::unsaved_question(*session(), *state().leaving, true, "run 1000000");
  EXPECT_NE(question.running.find("run 1000000"), std::string::npos) << question.running;
  for (int k = 0; k < 3; ++k) window_->frame();
  EXPECT_FALSE(window_->quit());
  window_->app().submit("answer cancel");
  window_->frame();
  EXPECT_TRUE(window_->app().engine().busy()) << "cancel lets it go on";
  window_->app().submit_by_person("quit");
  window_->frame();
  window_->app().submit("answer discard");
  window_->frame();
  window_->frame();
  EXPECT_TRUE(window_->quit());
  window_->settle();
  EXPECT_FALSE(window_->app().engine().busy());
}

TEST_F(Unsaved, ExportOverTheInputAsksAndKeepsACopy) {
  good("generate coast 300");
  good("export " + file("a.off"));
  const auto text_of = [](const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string before = text_of(file("a.off"));
  std::filesystem::create_symlink("a.off", file("link.off"));
  good("open " + file("a.off"));
  good("run 2");
  good("key Ctrl+S");
  type_name("export:file", file("link.off"));
  good("key Enter");
  EXPECT_EQ(state().dialog, ui::Dialog::Export) << "one Enter is not enough";
  EXPECT_EQ(text_of(file("a.off")), before);
  good("click export:over");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  EXPECT_NE(text_of(file("a.off")), before);
  EXPECT_EQ(text_of(file("a.orig.off")), before);
  EXPECT_NE(state().log.back().text.find("a.orig.off"), std::string::npos) << state().log.back().text;
}

TEST_F(Unsaved, WhatAWindowLeftIsOfferedAndRecovered) {
  using namespace std::chrono_literals;
  std::vector<Vec3> before;
  {
    Engine lost(1U);
    lost.autosave({folder_.path(), 1h});
    lost.post("generate coast 300");
    lost.post("run 3");
    lost.wait_idle();
    ASSERT_TRUE(lost.autosave_now(60s));
    before = lost.view()->frame->positions;
  }
  state().recoverable = find_recoverable(folder_.path());
  ASSERT_EQ(state().recoverable.size(), 1U);
  const SafeNames names = state().recoverable[0].names;
  window_->settle();
  EXPECT_EQ(state().dialog, ui::Dialog::Recover);
  good("key Escape");
  EXPECT_TRUE(state().recoverable.empty());
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  EXPECT_TRUE(std::filesystem::exists(names.session)) << "later";
  state().recoverable = find_recoverable(folder_.path());
  ASSERT_EQ(state().recoverable.size(), 1U);
  window_->settle();
  good("click recover:take");
  EXPECT_EQ(window_->app().frame()->positions, before);
  EXPECT_TRUE(title().starts_with("• "));
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  state().recovering.reset();
  state().recoverable = find_recoverable(folder_.path());
  ASSERT_EQ(state().recoverable.size(), 1U);
  window_->settle();
  good("click recover:discard");
  EXPECT_FALSE(std::filesystem::exists(names.session));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace dmoscope::app
