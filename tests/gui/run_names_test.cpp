// Names of runs in legends and over viewports, and the room for a plot whose legend has many of them.

#include "ui/state/run_names.h"

#include <set>

#include "tests/gui/headless_test.h"
#include "ui/state/format.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::app {
namespace {

class RunNames : public HeadlessTest {
 protected:
  [[nodiscard]] std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const ui::RunName& name : ui::run_names(*session())) all.push_back(name.whole());
    return all;
  }
  [[nodiscard]] ui::Items::Box box(const std::string& name) { return window_->app().items().find(name); }
};

TEST_F(RunNames, SayWhatTellsRunsApartAndNoMore) {
  good("generate annulus 300");
  EXPECT_EQ(names(), std::vector<std::string>{"1 dmo"});
  good("add-run laplace");
  EXPECT_EQ(names(), (std::vector<std::string>{"1 dmo", "2 laplace"}));
  good("add-run dmo:min-angle");
  EXPECT_EQ(names(), (std::vector<std::string>{"1 dmo · mean ratio", "2 laplace", "3 dmo · minimum angle"}));
  good("metric mean-ratio");
  good("order shuffle:7");
  good("then mean");
  EXPECT_EQ(names(), (std::vector<std::string>{"1 dmo", "2 laplace", "3 dmo · then mean, shuffle:7"}));
}

TEST_F(RunNames, TheListSaysAllThatTheViewportsTitlesSay) {
  good("generate annulus 300");
  good("add-run dmo:min-angle");
  good("then mean");
  good("add-run dmo:min-angle");
  good("rename-run 3 coarse");
  const auto all = ui::run_names(*session());
  EXPECT_EQ(all[0].method_and_aim() + "|" + all[0].other_differences(), "dmo · mean ratio|");
  EXPECT_EQ(all[1].method_and_aim() + "|" + all[1].other_differences(), "dmo · minimum angle|then mean");
  EXPECT_EQ(all[2].method_and_aim() + "|" + all[2].other_differences(), "coarse|");
  // Differences that a row has no room for stand in a second line.
  good("move 5 5");
  const auto height = [&](int run) { return box("run:" + std::to_string(run))[3] - box("run:" + std::to_string(run))[1]; };
  EXPECT_GE(height(1), 1.5F * height(0));
  EXPECT_EQ(height(2), height(0));
}

TEST_F(RunNames, SearchesAndPlacesTellApart) {
  good("generate annulus 300");
  good("run 1");
  good("grid 12");
  EXPECT_EQ(names(), (std::vector<std::string>{"1 dmo", "2 dmo · grid 12"}));
  EXPECT_EQ(session()->runs[1].title, "dmo · mean ratio, grid 12") << "and in the list";
  good("grid 8");
  good("combine mean-ratio:0.7:density h1:2,3");
  good("run 1");
  good("size-point 4 5");
  const auto all = names();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1], "2 dmo · mean ratio > 0.7 · density h1, at 2 3");
  EXPECT_EQ(all[2], "3 dmo · mean ratio > 0.7 · density h1, at 4 5");
}

TEST_F(RunNames, ATitleWithoutRoomKeepsWhatDiffers) {
  good("generate annulus 300");
  good("add-run dmo:min-angle");
  ui::PaneFacts pane;
  pane.session = session();
  auto pieces = ui::title_of(pane, Metric::MeanRatio);
  std::erase_if(pieces, [](const ui::TitlePiece& piece) { return piece.rank > 0; });
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].text, "2");
  EXPECT_EQ(pieces[1].text, "· minimum angle");
  good("add-run laplace");
  good("select-run 2");
  pane.session = session();
  EXPECT_EQ(ui::title_of(pane, Metric::MeanRatio).front().text, "2 dmo · minimum angle") << "where there are others, the method counts";
}

TEST(WithoutMiddle, KeepsBothEndsAndWholeLetters) {
  EXPECT_EQ(ui::without_middle("mean-ratio-area", 15), "mean-ratio-area");
  EXPECT_EQ(ui::without_middle("mean-ratio-area", 9), "mean-…area");
  EXPECT_EQ(ui::without_middle("a · · · b", 5), "a … b") << "no half of a dot";
}

TEST_F(RunNames, ARunThatIsSwitchedOffStaysSoUnderAnotherName) {
  good("generate annulus 300");
  good("add-run laplace");
  good("plot convergence");
  good("plot-series \"1 dmo\" off");
  good("plot-series minimum off");
  good("add-run dmo:min-angle");
  using Names = std::set<std::string>;
  EXPECT_EQ(state().plot_view().hidden, (Names{"1 dmo · mean ratio", "minimum"}));
  good("plot-series \"2 laplace\" off");
  good("remove-run 1");
  EXPECT_EQ(state().plot_view().hidden, (Names{"1 laplace", "minimum"})) << "not the run that was removed, nor the one now in its place";
  good("plot-series \"1 laplace\" only");
  good("add-run laplace:min-angle");
  EXPECT_EQ(state().plot_view().isolated, "1 laplace · mean ratio");
}

TEST_F(RunNames, ManyOfThemLeaveThePlotItsRoom) {
  good("generate annulus 200");
  good("compare orders 50 1");
  good("plot sorted");
  const auto plot = box("plot");
  EXPECT_GT(plot[3] - plot[1], 80.0F) << "of a panel of some 200";
  EXPECT_FALSE(window_->run("click \"legend:20 dmo · shuffle:19\"") == std::nullopt) << "has no room";
  good("click legend-more");
  good("click \"legend:20 dmo · shuffle:19\"");
  const ui::PlotView& view = state().plot_view();
  EXPECT_TRUE(view.hidden.contains("20 dmo · shuffle:19"));
}

}  // namespace
}  // namespace dmoscope::app
