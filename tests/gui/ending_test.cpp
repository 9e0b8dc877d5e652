// Notes of the window on a run that has come to its end, and its offers: elements that stay inverted, and better iterations.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <imgui.h>

#include "core/base/number_text.h"
#include "tests/gui/headless_test.h"
#include "tests/gui/squares.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/notice.h"
#include "ui/state/actions.h"

namespace dmoscope::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Ending : public HeadlessTest {
 protected:
  [[nodiscard]] bool has_item(const std::string& name) { return window_->app().items().boxes().contains(name); }
  [[nodiscard]] ui::Notice notice() { return ui::notice_of(*session()); }
  [[nodiscard]] RunView run() { return session()->runs.at(session()->active); }
  [[nodiscard]] bool best_is_possible() { return ui::enabled(*ui::find_action("best"), ui::situation_of(*session(), state(), false)); }
  /// Opens nine cells of two triangles. The corner of the first triangle lies beyond its other two: all three are fixed.
  void open_hopeless() {
    const std::filesystem::path file = folder_ / "hopeless.off";
    std::ofstream(file) << squares_with(3, 0, "0.9 0.9 0");
    good("open " + file.string());
  }
  test::TemporaryFolder folder_;
};

TEST_F(Ending, LeftInvertedIsSaidWithPlacesToGoTo) {
  open_hopeless();
  EXPECT_TRUE(notice().empty()) << "no run has come to its end yet";
  good("run 3");
  const ui::Notice said = notice();
  ASSERT_FALSE(said.empty());
  EXPECT_THAT(said.sentences, ElementsAre("1 element stays inverted. Look at element 0 and at vertex 0 at (0.9, 0.9, 0); it lies on the "
                                          "boundary, which stays."))
      << "and no method gets further";
  good("click notice:vertex");
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 0}));
  good("click notice:element");
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Element, 0}));
  good("step iteration");
  EXPECT_TRUE(notice().empty()) << "that is no run's end";
  EXPECT_FALSE(has_item("notice:vertex"));
}

TEST_F(Ending, IsHiddenUntilAnotherRunEnds) {
  open_hopeless();
  good("run 2");
  EXPECT_TRUE(has_item("notice")) << "a line";
  EXPECT_TRUE(has_item("notice-off"));
  EXPECT_FALSE(has_item("notice:vertex"));
  good("click notice");
  EXPECT_TRUE(has_item("notice:vertex"));
  good("click notice");
  EXPECT_FALSE(has_item("notice:vertex")) << "a second click folds it";
  good("click notice");
  good("click notice-off");
  EXPECT_FALSE(has_item("notice:vertex"));
  good("notice on");
  EXPECT_TRUE(has_item("notice:vertex"));
  good("notice off");
  good("run 1");
  EXPECT_TRUE(has_item("notice:vertex"));
}

TEST_F(Ending, TheNoteAndWarningsLeaveTheMeshInSight) {
  for (const auto& [width, height] : {std::pair{800, 600}, {1280, 800}}) {
    SCOPED_TRACE(width);
    open(width, height);
    good("generate coast 400");
    good("method laplace");
    good("run 60");
    const auto box = [&](const char* item) { return window_->app().items().find(item); };
    for (const char* layout : {"viewports 1", "viewports 4"}) {
      SCOPED_TRACE(layout);
      good(layout);
      for (const char* line : {"unfold-notice off", "unfold-notice on"}) {
        good(line);
        const float below = has_item("notice:best") ? box("notice:best")[3] : box("notice")[3];
        for (const ui::PaneFacts& pane : window_->app().panes()) EXPECT_LE(below, pane.rect.y) << line;
        for (const ui::PaneFacts& pane : window_->app().panes()) EXPECT_LE(pane.rect.y + pane.rect.h, box("status-message")[1]) << line;
      }
    }
    good("viewports 1");
    good("notice off");
    const float top = window_->app().panes()[0].rect.y;
    good("notice on");
    EXPECT_LT(top, window_->app().panes()[0].rect.y) << "it takes room of its own";
    // A message that must be read whole has as much of the lowest row as it needs.
    add_message(state(), {Message::Kind::Warning, "so many words that the room below the column of facts is not enough for them", 0});
    good("move 5 5");
    EXPECT_GT(box("status-message")[2] - box("status-message")[0], 20 * ImGui::GetFontSize());
    EXPECT_LE(box("viewport")[3], box("status-message")[1]);
  }
}

TEST_F(Ending, AMethodThatGetsFurtherIsOffered) {
  open_explaining();
  good("generate tangled");
  good("method dvr");
  good("run 1");
  ASSERT_GT(session()->frame->statistics.inverted, 0U);
  const auto ending = run().ending;
  ASSERT_TRUE(ending && ending->hint);
  EXPECT_LT(ending->hint->left, ending->left->all.all);
  EXPECT_THAT(notice().sentences[1], HasSubstr(ending->hint->method + " leaves "));
  const std::string method = ending->hint->method;
  const std::uint64_t iterations = ending->hint->iterations;
  const Index left = ending->hint->left;
  good("click notice:method");
  EXPECT_EQ(run().parameters.method, method);
  EXPECT_EQ(session()->runs.size(), 2U);
  good("run " + std::to_string(iterations));
  EXPECT_EQ(session()->frame->statistics.inverted, left) << "as was promised";
}

TEST_F(Ending, WhatEndsWorseThanItsBestOffersThat) {
  good("generate tangled");
  EXPECT_FALSE(has_item("method-note"));
  good("method laplace");
  EXPECT_TRUE(has_item("method-note"));
  good("run 60");
  // The best iteration by the exact minima.
  std::uint64_t best = 0;
  const RunView now = run();
  for (std::uint64_t i = 1; i < now.records.size(); ++i) {
    const Statistics &a = now.records[i].statistics, &b = now.records[best].statistics;
    if (a.inverted < b.inverted || (a.inverted == b.inverted && a.minimum > b.minimum)) best = i;
  }
  ASSERT_LT(best, 60U);
  EXPECT_EQ(now.best_iteration, best);
  ASSERT_FALSE(notice().empty());
  EXPECT_EQ(notice().sentences.back(),
            "laplace may make elements worse: the best iteration was iteration " + std::to_string(best) + ", not iteration 60.");
  EXPECT_TRUE(best_is_possible());
  good("click notice:best");
  EXPECT_EQ(run().moment, (Moment{best}));
  EXPECT_TRUE(notice().empty());
  EXPECT_FALSE(best_is_possible());
  good("timeline last");
  EXPECT_TRUE(best_is_possible());
  good("click timeline-more");
  good("click best");
  EXPECT_EQ(run().moment, (Moment{best}));
  good("timeline last");
  good("key Shift+End");
  EXPECT_EQ(run().moment, (Moment{best}));
}

TEST_F(Ending, WhatOptimisesEndsAtItsBest) {
  good("generate grid 200");
  EXPECT_FALSE(best_is_possible());
  good("run 5");
  EXPECT_TRUE(notice().empty());
  EXPECT_FALSE(best_is_possible());
  good("seek 2");
  EXPECT_TRUE(best_is_possible());
}

TEST_F(Ending, WhatTheMeanLostIsSaidAndGotBackByOneClick) {
  good("generate random 400");
  good("until-converged best");
  const RunView ended = run();
  const Statistics &input = ended.records.front().statistics, lost = ended.records[ended.moment.iteration].statistics;
  ASSERT_LT(lost.mean, input.mean) << "else this test shows nothing";
  ASSERT_FALSE(notice().empty());
  EXPECT_THAT(notice().sentences[0], HasSubstr("Worse than the input: mean of mean ratio"));
  ASSERT_EQ(notice().figures.size(), 5U) << "a head, and two rows a metric";
  EXPECT_EQ(notice().figures[1].name, "mean ratio was");
  EXPECT_EQ(notice().figures[1].cells[3].text, fmt::format("{:.3f}", input.mean));
  EXPECT_EQ(notice().figures[2].cells[3].text, fmt::format("{:.3f}", lost.mean));
  EXPECT_EQ(notice().figures[2].cells[3].verdict, Verdict::Worse);
  EXPECT_EQ(notice().figures[2].cells[0].text, fmt::format("{:.3f}", lost.minimum));
  ASSERT_LT(ended.moment.iteration + 1, ended.records.size()) << "it has gone back";
  EXPECT_THAT(notice().sentences[1], HasSubstr("went on to iteration " + std::to_string(ended.records.size() - 1)));
  good("click notice:raise-mean");
  ASSERT_EQ(session()->runs.size(), 2U);
  EXPECT_TRUE(run().parameters.then_mean);
  const Statistics raised = run().records[run().moment.iteration].statistics;
  EXPECT_GT(raised.mean, lost.mean + 0.005);
  EXPECT_GT(raised.minimum, lost.minimum - 1e-6);
  EXPECT_TRUE(notice().empty()) << "there is no more to be had";
}

TEST_F(Ending, LaplaceIsToldWhatItMadeWorse) {
  const std::filesystem::path file = folder_ / "dart.off";  // the mean of its corners lies outside
  std::ofstream(file) << "OFF\n5 4 0\n-4 -4 0\n0 0 0\n4 -4 0\n0 2 0\n0 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  good("open " + file.string());
  good("method laplace");
  good("run 30");
  EXPECT_THAT(notice().sentences, ::testing::Contains("laplace made elements worse: 2 are inverted now, 0 before."));
  good("until-converged best 3 20");
  ASSERT_FALSE(notice().empty());
  EXPECT_THAT(notice().sentences.back(), HasSubstr("the run is back there."));
  EXPECT_FALSE(has_item("notice:best"));
}

}  // namespace
}  // namespace dmoscope::app
