// A person's actions, recorded, saved as a script and repeated in a fresh window.
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"
#include "tests/support/temporary_folder.h"
#include "ui/state/command_log.h"

namespace dmoscope::app {
namespace {

struct Reached {
  std::vector<Vec3> positions;
  Moment moment;
  render::Image picture;
};

class Replay : public HeadlessTest {
 protected:
  [[nodiscard]] Reached reached() {
    const auto view = window_->app().engine().view();
    add_message(state(), {Message::Kind::Info, "reached", 0});  // messages from before are not compared
    window_->settle();
    return {view->frame->positions, view->frame->moment, window_->picture()};
  }
  /// Runs a cancelled command as far as `iteration`.
  void cancel_after(const std::string& line, std::uint64_t iteration) {
    window_->app().submit(line);
    const auto moment = [this] { return window_->app().engine().view()->frame->moment; };
    while (moment().iteration < iteration && window_->app().engine().busy()) window_->frame();
    window_->app().submit("cancel");
    window_->settle();
  }
  /// Text of the script; fills lines_.
  std::string saved() {
    const auto path = folder_ / "recorded session.txt";
    good("save-script \"" + path.string() + "\"");
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    lines_.clear();
    for (std::string line; std::getline(text, line);) lines_.push_back(line);
    return text.str();
  }
  /// Checks that the saved script in a fresh window has the same result.
  void replays_to(const Reached& wanted) {
    open();
    for (const std::string& line : lines_) good(line);
    good("move 2 2");
    const Reached found = reached();
    EXPECT_EQ(found.moment, wanted.moment);
    EXPECT_EQ(found.positions, wanted.positions);
    const render::Difference difference = render::compare(found.picture, wanted.picture);
    EXPECT_TRUE(difference.alike()) << difference.off_share << " of the pixels differ";
  }
  [[nodiscard]] std::size_t count(std::string_view line) const { return static_cast<std::size_t>(std::ranges::count(lines_, line)); }

  const test::TemporaryFolder folder_;
  std::vector<std::string> lines_;
};

TEST_F(Replay, ClicksKeysWheelAndDragsComeToTheSameMeshAndPicture) {
  for (const char* line : {"size 1280 880",
                           "dock setup left",
                           "click sample:coast",
                           "key N",
                           "click step-class",
                           "key V",
                           "wheel 500 300 3",
                           "drag 500 300 430 260",
                           "key W",
                           "key D",
                           "key M",
                           "click worst:0",
                           "key Shift+M",
                           "drag splitter:left 330 400",
                           "drag 500 300 520 330",
                           "key Alt+2",
                           "key Ctrl+P",
                           "type \"step vertex 7\"",
                           "key Enter",
                           "size 1200 760",
                           "key B",
                           "theme light",
                           "key F6",
                           "key Escape",
                           "wheel 600 300 -1"}) {
    if (std::string_view(line).starts_with("drag splitter")) {
      const auto box = window_->app().items().find("splitter:left");
      const float x = (box[0] + box[2]) / 2, y = (box[1] + box[3]) / 2;
      good("drag " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x + 40) + " " + std::to_string(y));
    } else {
      good(line);
    }
  }
  good("move 2 2");
  const Reached wanted = reached();
  const std::string script = saved();
  for (const char* noise : {"\nclick", "\nkey", "\nwheel", "\ndrag", "\ndialog", "\ntype", "\nmove"})
    EXPECT_EQ(script.find(noise), std::string::npos) << noise << script;
  EXPECT_NE(script.find("\npanel-size left "), std::string::npos) << script;
  EXPECT_NE(script.find("\ncamera "), std::string::npos) << script;
  EXPECT_EQ(count("step vertex 7"), 1U);
  replays_to(wanted);
}

TEST_F(Replay, MovementsOfTheMouseAreOneLine) {
  good("generate annulus");
  for (int k = 0; k < 5; ++k) good("drag 500 300 520 310");
  good("wheel 500 300 1");
  good("key N");
  good("key N");
  (void)saved();
  EXPECT_EQ(std::ranges::count_if(lines_, [](const std::string& line) { return line.starts_with("camera "); }), 1);
}

TEST_F(Replay, WhatFailedIsAComment) {
  good("generate annulus");
  good("step iteration");
  EXPECT_TRUE(window_->run("seek nowhere").has_value());
  good("dialog none");
  EXPECT_TRUE(window_->run("theme pink").has_value());
  EXPECT_TRUE(window_->run("step sideways").has_value());
  good("dialog none");
  good("move 2 2");
  const Reached wanted = reached();
  (void)saved();
  EXPECT_EQ(count("# failed: seek nowhere"), 1U);
  EXPECT_EQ(count("theme pink"), 0U);
  replays_to(wanted);
}

TEST_F(Replay, CancelledWorkComesToTheVeryMoment) {
  good("generate coast");
  cancel_after("run 100000", 3);
  good("key V");
  good("move 2 2");
  const Reached wanted = reached();
  ASSERT_GE(wanted.moment.iteration, 3U);
  (void)saved();
  EXPECT_EQ(count("# cancelled: run 100000"), 1U);
  replays_to(wanted);
}

TEST_F(Replay, SpaceAndItsStopAreTheMomentReached) {
  good("generate coast");
  cancel_after("run-pause", 2);
  const Reached wanted = reached();
  (void)saved();
  EXPECT_EQ(count("run-pause"), 0U);
  open();
  for (const std::string& line : lines_) good(line);
  EXPECT_EQ(reached().positions, wanted.positions);
}

TEST_F(Replay, TheLogListsCommandsAndMessagesAndFinds) {
  good("generate annulus");
  good("step iteration");
  good("key F6");
  EXPECT_EQ(window_->app().state().dialog, ui::Dialog::Log);
  const auto& items = window_->app().items().boxes();
  EXPECT_TRUE(items.contains("log:0"));
  good("click log:filter");
  good("type \"step iter\"");
  EXPECT_TRUE(window_->app().items().boxes().contains("log:0"));
  EXPECT_FALSE(window_->app().items().boxes().contains("log:1"));
  good("click log:0");
  EXPECT_EQ(window_->clipboard(), "step iteration");
}

TEST(CommandLog, DropsOldLinesButNotOfTheScriptAndRefusesWhatIsTooLong) {
  ui::CommandLog log;
  const std::vector<std::string> look{"theme dark"};
  const auto command = [&](const std::string& line) {
    log.begin(line, look);
    log.end(look);
  };
  command("generate coast");
  for (std::size_t k = 0; k < ui::CommandLog::kMostLines + 50; ++k) command("zoom 1");
  EXPECT_EQ(log.lines().size(), ui::CommandLog::kMostLines);
  EXPECT_NE(log.script(look).find("\ngenerate coast\n"), std::string::npos);
  for (std::size_t k = 0; k < ui::CommandLog::kMostSteps; ++k) command("zoom 1");
  EXPECT_THROW((void)log.script(look), UsageError);
}

TEST(CommandLog, ANumberedCommandEndsAsItsOwn) {
  ui::CommandLog log;
  for (std::uint64_t id = 1; id <= 3; ++id) {
    log.begin("run 5", {});
    log.posted("run 5", id);
    log.end({});
  }
  log.ended({1, CommandEnd::Kind::Done, {5, 0}, true});
  log.ended({3, CommandEnd::Kind::Dropped, {}, false});  // reported before the one at work
  log.ended({2, CommandEnd::Kind::Cancelled, {7, 12}, true, {"seek 7 12 0"}});
  EXPECT_EQ(log.script({}),
            "# A recorded session: dmoscope script FILE [--headless]\nrun 5\n# cancelled: run 5\nseek 7 12 0\n# cancelled before it began: "
            "run 5\n");
  EXPECT_EQ(log.lines()[1].state, ui::LogLine::State::Cancelled);
}

}  // namespace
}  // namespace dmoscope::app
