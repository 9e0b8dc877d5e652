// Marks A and B, playing, and pictures of a run.
#include "ui/state/timeline.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;

class Timeline : public HeadlessTest {
 protected:
  [[nodiscard]] const Frame& shown() { return *window_->app().frame(); }
  [[nodiscard]] render::Image mesh() { return window_->app().mesh_picture({}); }
};

TEST_F(Timeline, FlippingShowsTheMarkedMomentsWhole) {
  good("generate annulus");
  good("step iteration");
  const std::vector<Vec3> at_a = shown().positions;
  const render::Image picture_a = mesh();
  good("key Shift+A");
  good("step iteration 3");
  const std::vector<Vec3> at_b = shown().positions;
  good("key Shift+B");
  good("step class");
  ASSERT_NE(at_a, at_b);
  good("key X");
  EXPECT_EQ(shown().moment, (Moment{1, 0}));
  EXPECT_EQ(shown().positions, at_a);
  EXPECT_TRUE(render::compare(mesh(), picture_a).alike());
  EXPECT_EQ(session()->frame->moment.iteration, 4U);  // the session does not move
  good("key X");
  EXPECT_EQ(shown().positions, at_b);
  good("key X");
  EXPECT_EQ(shown().positions, at_a);
  good("key Shift+X");
  EXPECT_EQ(shown().serial, session()->frame->serial);
}

TEST_F(Timeline, LiesOnTheAxisOfThePlotAboveIt) {
  good("generate annulus 400");
  good("run 12");
  const auto box = [&](const char* item) { return window_->app().items().find(item); };
  for (const char* axis : {"x-axis log", "x-axis linear", "plot-x seconds"}) {
    good(axis);
    EXPECT_NEAR(box("timeline")[0], box("plot")[0], 0.51F) << axis;
    EXPECT_NEAR(box("timeline")[2], box("plot")[2], 0.51F) << axis;
    // A click in the plot and one below it lead to the same iteration.
    for (const float share : {0.0F, 0.31F, 0.62F, 1.0F}) {
      const float x = box("plot")[0] + share * (box("plot")[2] - box("plot")[0]);
      good(fmt::format("click {} {}", x, (box("plot")[1] + box("plot")[3]) / 2));
      const std::uint64_t by_plot = session()->frame->moment.iteration;
      good("seek 6");
      good(fmt::format("click {} {}", x, (box("timeline")[1] + box("timeline")[3]) / 2));
      EXPECT_EQ(session()->frame->moment.iteration, by_plot) << axis << ' ' << share;
    }
  }
  good("plot histogram");
  EXPECT_LT(box("plot")[0], box("timeline")[0]) << "which has no iterations along it";
  good("panel bottom off");
  EXPECT_EQ(box("timeline")[2] - box("timeline")[0] > 600.0F, true);
}

TEST_F(Timeline, WhateverMovesTheMeshShowsNowAgain) {
  good("generate annulus");
  good("mark a");
  good("step iteration 2");
  good("flip a");
  EXPECT_EQ(shown().moment.iteration, 0U);
  good("key N");
  EXPECT_EQ(shown().moment.iteration, 3U);
}

TEST_F(Timeline, OneMarkFlipsWithNow) {
  good("generate annulus");
  good("step iteration");
  good("mark b");
  good("step iteration");
  good("flip");
  EXPECT_EQ(shown().moment.iteration, 1U);
  good("flip");
  EXPECT_EQ(shown().moment.iteration, 2U);
}

TEST_F(Timeline, MarksGoWithTheirMeshAndNoneIsSaidCalmly) {
  good("generate annulus");
  good("mark a");
  good("generate quads");
  EXPECT_EQ(window_->app().state().timeline.a.frame, nullptr);
  good("flip");
  EXPECT_EQ(window_->app().state().dialog, ui::Dialog::None);
  EXPECT_NE(window_->app().state().log.back().text.find("nothing is marked"), std::string::npos);
  EXPECT_TRUE(window_->run("flip b").has_value());
}

TEST_F(Timeline, PlaysTheHistoryToItsEnd) {
  good("generate annulus");
  good("step iteration 6");
  good("seek 2");
  good("speed 60");
  good("play");
  EXPECT_EQ(shown().moment.iteration, 6U);
  EXPECT_EQ(window_->app().state().timeline.play.kind, ui::Playback::Kind::Off);
  const auto& lines = window_->app().state().commands.lines();
  for (const char* line : {"seek 3", "seek 4", "seek 5", "seek 6"})
    EXPECT_EQ(std::ranges::count(lines, line, &ui::LogLine::text), 1) << line;
  good("play");  // starts again, because it was at its end
  EXPECT_EQ(std::ranges::count(lines, "seek 0", &ui::LogLine::text), 1);
  EXPECT_EQ(std::ranges::count(lines, "seek 1", &ui::LogLine::text), 1);
  EXPECT_EQ(shown().moment.iteration, 6U);
}

TEST_F(Timeline, StepsUntilSpaceIsPressed) {
  good("generate coast");
  good("speed 60");
  window_->app().submit("play-steps vertex");
  for (int k = 0; k < 3000 && shown().moment.visits < 5; ++k) window_->frame();
  EXPECT_GE(shown().moment.visits, 5U);
  EXPECT_EQ(shown().moment.iteration, 0U);
  good("key Space");
  const Moment stopped = session()->frame->moment;
  for (int k = 0; k < 60; ++k) window_->frame();
  EXPECT_EQ(session()->frame->moment, stopped);
}

TEST(Playback, IsDueEveryIntervalAndNeverCatchesUp) {
  SessionView session;
  session.runs.resize(1);
  ui::Playback play;
  EXPECT_FALSE(ui::next_command(play, session, 5.0).has_value());
  play.kind = ui::Playback::Kind::Class;
  play.speed = 4.0;
  play.due = 1.0;
  EXPECT_FALSE(ui::next_command(play, session, 0.99).has_value());
  EXPECT_EQ(ui::next_command(play, session, 1.0), "step class");
  EXPECT_FALSE(ui::next_command(play, session, 1.24).has_value());
  EXPECT_EQ(ui::next_command(play, session, 9.0), "step class");
  EXPECT_EQ(play.due, 9.0);  // skipped moments are not made up for
}

TEST_F(Timeline, ASequenceIsAPictureOfEveryIterationAskedFor) {
  const fs::path folder = fs::path(testing::TempDir()) / "dmoscope pictures";
  fs::remove_all(folder);
  good("generate annulus");
  good("step iteration 5");
  good("seek 3");
  good("step class");
  const Moment before = shown().moment;
  good("sequence \"" + folder.string() + "\" --every 2 --size 320x200");
  EXPECT_EQ(shown().moment, before);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"frame-0000.png", "frame-0001.png", "frame-0002.png", "frame-0003.png"}));
  for (const auto& [iteration, name] : {std::pair{"0", "frame-0000.png"}, {"4", "frame-0002.png"}, {"5", "frame-0003.png"}}) {
    good(std::string("seek ") + iteration);
    const fs::path single = folder / "single";
    good("screenshot \"" + single.string() + ".png\" --size 320x200");
    const render::Image a = render::read_png(folder / name), b = render::read_png(single.string() + ".png");
    EXPECT_TRUE(render::compare(a, b).alike()) << name;
  }
  EXPECT_TRUE(window_->run("sequence \"" + folder.string() + "\"").has_value());  // frames exist already
  good("dialog none");
  good("sequence \"" + folder.string() + "\" --to 1 --overwrite --window");
  EXPECT_TRUE(fs::exists(folder / "frame-0001.png"));
  EXPECT_FALSE(fs::exists(folder / "frame-0002.png"));  // removed with the older sequence
  EXPECT_EQ(render::read_png(folder / "frame-0000.png").width, 1280);
  const std::string& said = window_->app().state().log.back().text;
  EXPECT_NE(said.find("ffmpeg -framerate 10 "), std::string::npos) << said;
}

TEST_F(Timeline, ASequenceCanBeCancelledAndRefusesNonsense) {
  const fs::path folder = fs::path(testing::TempDir()) / "dmoscope pictures cancelled";
  fs::remove_all(folder);
  EXPECT_TRUE(window_->run("sequence \"" + folder.string() + "\"").has_value());  // there is no mesh
  good("dialog none");
  good("generate annulus");
  good("step iteration 30");
  EXPECT_TRUE(window_->run("sequence \"" + folder.string() + "\" --from 3 --to 2").has_value());
  EXPECT_TRUE(window_->run("sequence \"" + folder.string() + "\" --to 31").has_value());
  EXPECT_TRUE(window_->run("sequence /proc/none/x").has_value());
  EXPECT_FALSE(fs::exists(folder));
  good("dialog none");
  window_->app().submit("sequence \"" + folder.string() + "\" --size 64x64");
  for (int k = 0; k < 1000 && !fs::exists(folder / "frame-0002.png"); ++k) window_->frame();
  window_->app().submit("cancel");
  window_->settle();
  EXPECT_EQ(shown().moment, (Moment{30, 0}));
  EXPECT_FALSE(fs::exists(folder / "frame-0029.png"));
}

TEST(Sequence, TheVideosLineQuotesWhatNeedsIt) {
  EXPECT_EQ(ui::video_line("/a b/c/", 12.5),
            "ffmpeg -framerate 12.5 -i \"/a b/c/frame-%04d.png\" -vf \"pad=ceil(iw/2)*2:ceil(ih/2)*2\" -c:v libx264 -pix_fmt yuv420p "
            "\"/a b/c.mp4\"");
}

}  // namespace
}  // namespace dmoscope::app
