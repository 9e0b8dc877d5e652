// The list of runs: numbers, names, eyes, and constant height.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/plots/plot_builder.h"
#include "ui/plots/run_rows.h"
#include "ui/state/run_names.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class RunList : public HeadlessTest {
 protected:
  [[nodiscard]] ui::Items::Box box(const std::string& item) { return window_->app().items().find(item); }
  [[nodiscard]] bool on_screen(const std::string& item) { return window_->app().items().boxes().contains(item); }
  [[nodiscard]] std::vector<std::string> legend() {
    std::vector<std::string> names;
    for (const ui::LegendEntry& entry : ui::build_plot(state(), *session(), {}, ui::palette(ui::Theme::Dark)).legend)
      if (entry.of_run) names.push_back(entry.name);
    return names;
  }
  [[nodiscard]] std::string table_title(std::size_t run) { return ui::sorted_runs(*session(), state().plot_options)[run].title; }
  const test::TemporaryFolder folder_;
};

TEST_F(RunList, ScrollsByItselfHoweverManyRunsThereAre) {
  good("generate annulus 200");
  const auto method = box("method"), list = box("run-list");
  good("compare orders 7 1");
  EXPECT_EQ(box("method"), method);
  good("compare orders 50 1");
  ASSERT_GE(session()->runs.size(), 51U);
  EXPECT_EQ(box("method"), method) << "the parameters stay in sight";
  EXPECT_EQ(box("run-list"), list);
  EXPECT_TRUE(on_screen(fmt::format("run:{}", session()->active))) << "the list goes to the active run";
  good("select-run 51");
  EXPECT_TRUE(on_screen("run:50"));
  EXPECT_FALSE(on_screen("run:0"));
  good("select-run 1");
  EXPECT_TRUE(on_screen("run:0"));
  EXPECT_FALSE(on_screen("run:40"));
}

TEST_F(RunList, EveryPlaceCallsARunAlike) {
  good("generate annulus 300");
  EXPECT_EQ(ui::run_title(*session(), 0), "dmo · mean ratio") << "one run needs no number";
  good("add-run dmo:min-angle");
  EXPECT_EQ(ui::run_title(*session(), 1), "2 dmo · minimum angle");
  EXPECT_EQ(table_title(1), "2 dmo · minimum angle");
  EXPECT_THAT(legend(), ElementsAre("1 dmo · mean ratio", "2 dmo · minimum angle"));
  good("mark a");
  EXPECT_EQ(state().timeline.a.title, "2 dmo · minimum angle");
}

TEST_F(RunList, ADoubleClickRenamesARunEverywhere) {
  good("generate annulus 300");
  good("add-run laplace");
  good("double-click run:1");
  ASSERT_TRUE(state().renaming_run.has_value());
  good("type \"by hand\"");
  good("key Enter");
  EXPECT_FALSE(state().renaming_run.has_value());
  EXPECT_EQ(session()->runs[1].name, "by hand");
  EXPECT_EQ(ui::run_title(*session(), 1), "2 by hand");
  EXPECT_THAT(legend(), ElementsAre("1 dmo", "2 by hand"));
  EXPECT_EQ(table_title(1), "2 by hand");
  ui::PaneFacts pane;
  pane.session = session();
  pane.of_run = true;
  EXPECT_EQ(ui::title_of(pane, Metric::MeanRatio).front().text, "2 by hand");
  good("run 1");
  const auto file = folder_ / "stats.csv";
  good("stats \"" + file.string() + "\"");
  std::string text(std::filesystem::file_size(file), ' ');
  std::ifstream(file).read(text.data(), static_cast<std::streamsize>(text.size()));
  EXPECT_THAT(text, HasSubstr("\nby hand,1,"));
  good("key Ctrl+Z");  // undoes the iteration
  good("key Ctrl+Z");
  EXPECT_EQ(session()->runs[1].name, "") << "a name can be undone";
  good("key Ctrl+Y");
  EXPECT_EQ(session()->runs[1].name, "by hand");
  good("rename-run 2 \"\"");
  EXPECT_EQ(ui::run_title(*session(), 1), "2 laplace · mean ratio");
}

TEST_F(RunList, F2RenamesTheRunUnderTheMouseAndElseFoldsThePanel) {
  good("generate annulus 300");
  good("add-run laplace");
  good("move run:0");
  good("key F2");
  EXPECT_TRUE(state().panels.setup);
  EXPECT_EQ(state().renaming_run, session()->runs[0].id);
  good("type \"never mind\"");
  good("key Escape");
  EXPECT_FALSE(state().renaming_run.has_value());
  EXPECT_EQ(session()->runs[0].name, "");
  good("move 640 300");
  good("key F2");
  EXPECT_FALSE(state().panels.setup);
  good("key F2");
  good("key Shift+F2");
  EXPECT_EQ(state().renaming_run, session()->runs[1].id) << "the active one";
}

TEST_F(RunList, NamesThatCannotBeShownAreRefused) {
  good("generate annulus 300");
  EXPECT_TRUE(window_->run("rename-run 2 other").has_value()) << "there is no such run";
  EXPECT_TRUE(window_->run("rename-run 1 \"   \"").has_value());
  EXPECT_TRUE(window_->run("rename-run 1 " + std::string(61, 'a')).has_value());
  EXPECT_TRUE(window_->run("rename-run 1 \xff\xfe").has_value());
  good("rename-run 1 " + std::string(60, 'a'));
}

TEST_F(RunList, NamesAndEyesComeBackWithTheSession) {
  good("generate annulus 300");
  good("add-run laplace");
  good("add-run dvr");
  good("rename-run 2 \"x = 3, ümlaut\"");
  good("hide-run 2 on");
  const std::string path = (folder_ / "session.json").string();
  good("save-session \"" + path + "\"");
  open();
  good("open-session \"" + path + "\"");
  EXPECT_EQ(session()->runs[1].name, "x = 3, ümlaut");
  EXPECT_THAT(legend(), ElementsAre("1 dmo", "3 dvr"));
}

TEST_F(RunList, AnEyeTakesARunOutOfPlotsAndViewports) {
  good("generate annulus 300");
  good("add-run laplace");
  good("add-run dvr");
  good("viewports 4");
  const auto shown = [&] {
    std::vector<std::string> words;
    for (const ui::Pane& pane : state().panes.panes) words.push_back(state().panes.words(pane.content));
    return words;
  };
  EXPECT_THAT(shown(), ElementsAre("run 1", "run 2", "run 3", "input"));
  good("click run-eye:2");
  EXPECT_THAT(shown(), ElementsAre("run 1", "auto", "run 3", "input"));
  EXPECT_THAT(legend(), ElementsAre("1 dmo", "3 dvr"));
  for (const ui::Series& series : ui::build_plot(state(), *session(), {}, ui::palette(ui::Theme::Dark)).series)
    EXPECT_FALSE(series.run.starts_with("2 ")) << series.run;
  good("click run-eye:2");
  EXPECT_THAT(legend(), ElementsAre("1 dmo", "2 laplace", "3 dvr"));
  good("hide-run others");
  EXPECT_THAT(legend(), ElementsAre("3 dvr"));
  good("pane 1 run 2");  // a run that was asked for is shown
  EXPECT_THAT(legend(), ElementsAre("2 laplace", "3 dvr"));
  good("hide-run none");
  EXPECT_EQ(legend().size(), 3U);
  EXPECT_TRUE(window_->run("hide-run 9").has_value());
}

TEST_F(RunList, ARunIsRemovedByItsButtonAndComesBackByUndo) {
  good("generate annulus 300");
  good("click run-remove:1");
  EXPECT_EQ(session()->runs.size(), 1U) << "the last one stays";
  good("add-run laplace");
  good("click run-remove:1");
  ASSERT_EQ(session()->runs.size(), 1U);
  EXPECT_EQ(session()->runs[0].parameters.method, "laplace");
  good("key Ctrl+Z");
  EXPECT_EQ(session()->runs.size(), 2U);
}

TEST_F(RunList, NamesOfOlderScriptsStillSwitchARunOff) {
  good("generate annulus 300");
  good("add-run dmo:min-angle");
  good("plot convergence");
  good("plot-series \"2 dmo min-angle\" off");
  EXPECT_THAT(state().plot_view().hidden, ElementsAre("2 dmo · minimum angle"));
}

}  // namespace
}  // namespace dmoscope::app
