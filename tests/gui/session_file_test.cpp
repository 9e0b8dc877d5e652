// A session saved in one window and opened in another.
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::app {
namespace {

class SessionFile : public HeadlessTest {
 protected:
  const test::TemporaryFolder folder_;
  const std::string file_ = (folder_ / "a session.dmoscope").string();
};

TEST_F(SessionFile, GoesOnInAnotherWindowWithTheSameMeshAndPicture) {
  for (const char* line : {"generate coast",
                           "step iteration 3",
                           "add-run dmo:radius-ratio",
                           "step iteration 2",
                           "step class",
                           "pick vertex 700",
                           "goto vertex 700",
                           "zoom 0.5",
                           "colormap magma",
                           "vertices on",
                           "plot histogram",
                           "panel-size left 20",
                           "color-by valence",
                           "range 0.25 0.75",
                           "reverse-colors on",
                           "filter 0.5 0.9",
                           "filter-mode isolate",
                           "worst-view 40",
                           "labels vertices",
                           "arrows input",
                           "next-class on",
                           "select vertex 12-20 33",
                           "move 2 2"})
    good(line);
  const auto before = window_->app().engine().view();
  add_message(state(), {Message::Kind::Info, "reached", 0});  // messages from before are not compared
  window_->settle();
  const render::Image picture = window_->picture();
  good("save-session \"" + file_ + "\"");
  open();
  good("open-session \"" + file_ + "\"");
  good("move 2 2");
  const auto after = window_->app().engine().view();
  EXPECT_EQ(after->frame->positions, before->frame->positions);
  EXPECT_EQ(after->frame->moment, before->frame->moment);
  ASSERT_EQ(after->runs.size(), before->runs.size());
  EXPECT_EQ(after->active, before->active);
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 700}));
  EXPECT_EQ(state().plot, ui::PlotTab::Histogram);
  EXPECT_EQ(state().colouring.by, ui::ColourBy::Valence);
  EXPECT_EQ(state().colouring.filter, (std::pair{0.5, 0.9}));
  EXPECT_EQ(state().range_mode, ui::RangeMode::Given);
  EXPECT_EQ(state().stepping.arrows, ui::Reference::Input);
  EXPECT_EQ(state().selection.vertices(), (std::vector<Index>{12, 13, 14, 15, 16, 17, 18, 19, 20, 33}));
  add_message(state(), {Message::Kind::Info, "reached", 0});
  window_->settle();
  const render::Difference difference = render::compare(window_->picture(), picture);
  EXPECT_TRUE(difference.alike(0.01)) << difference.off_share;
}

TEST_F(SessionFile, AViewThatMakesNoSenseIsNamedAndTheMeshStays) {
  good("generate annulus");
  good("step iteration 2");
  good("save-session \"" + file_ + "\"");
  std::ifstream in(file_);
  std::stringstream text;
  text << in.rdbuf();
  std::string changed = text.str();
  const std::size_t at = changed.find("\"wireframe\"");
  ASSERT_NE(at, std::string::npos);
  changed.replace(changed.find_first_of("tf", changed.find(':', at)), 4, "1234");
  std::ofstream(file_) << changed;
  open();
  const auto failure = window_->run("open-session \"" + file_ + "\"");
  EXPECT_EQ(window_->app().frame()->moment.iteration, 2U);
  EXPECT_EQ(state().dialog, ui::Dialog::Error);
  EXPECT_NE(state().error_text.find("view.wireframe"), std::string::npos) << state().error_text;
}

}  // namespace
}  // namespace dmoscope::app
