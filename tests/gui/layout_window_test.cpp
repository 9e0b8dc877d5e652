// Panels that resize and fold, and controls that stay where they are.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "ui/commands/settings.h"
#include "ui/toolkit/layout.h"

namespace dmoscope::app {
namespace {

using Box = ui::Items::Box;

class LayoutWindow : public HeadlessTest {
 protected:
  [[nodiscard]] Box box(const std::string& item) { return window_->app().items().find(item); }
  [[nodiscard]] auto boxes() { return window_->app().items().boxes(); }
  void drag(const std::string& item, float dx, float dy) {
    const Box at = box(item);
    const float x = (at[0] + at[2]) / 2, y = at[1] + 0.3F * (at[3] - at[1]);
    good(fmt::format("drag {} {} {} {}", x, y, x + dx, y + dy));
  }
};

TEST(PanelSizes, LeaveTwoThirdsOfTheWidthToTheMesh) {
  for (const auto& [width, height, em] : {std::tuple{1280.0F, 800.0F, 15.0F}, {1920.0F, 1080.0F, 15.0F}, {2560.0F, 1600.0F, 30.0F}})
    EXPECT_GE(ui::compute_layout({}, width, height, {em, 20 * em, 50 * em}).viewport.w, 0.65F * width) << width;
}

TEST(PanelSizes, OfOlderSettingsStayWhereTheyWereChosen) {
  ui::ViewState state;
  ASSERT_TRUE(ui::apply_settings(R"({"panels": {"left_width": 17.0, "right_width": 22.0, "bottom_height": 15.0}})", state));
  EXPECT_EQ(state.panels.left_width, ui::Panels{}.left_width) << "nobody had chosen these";
  EXPECT_EQ(state.panels.right_width, ui::Panels{}.right_width);
  ASSERT_TRUE(ui::apply_settings(R"({"panels": {"left_width": 18.5, "right_width": 22.0}})", state));
  EXPECT_EQ(state.panels.left_width, 18.5);
  state.panels.left_width = 17.0;
  state.panels.runs_height = 11.0;
  ui::ViewState read;
  ASSERT_TRUE(ui::apply_settings(ui::settings_text(state), read));
  EXPECT_EQ(read.panels.left_width, 17.0) << "chosen now";
  EXPECT_EQ(read.panels.runs_height, 11.0);
}

TEST(PanelSizes, LeaveMostOfTheWindowToTheMesh) {
  const auto share = [](const ui::Panels& panels, float width, float height) {
    const ui::Layout layout = ui::compute_layout(panels, width, height, {15, 300, 700});
    EXPECT_EQ(layout.bottom.empty() ? layout.viewport.w : layout.bottom.w, layout.viewport.w) << "the column has the whole height";
    EXPECT_EQ(layout.right.h, layout.viewport.h + layout.bottom.h);
    return layout.viewport.w * layout.viewport.h / (width * height);
  };
  ui::Panels panels;
  EXPECT_GE(share(panels, 1280, 800), 0.70F);
  EXPECT_GE(share(panels, 1920, 1080), 0.79F);
  panels.plots_wait = false;
  EXPECT_GE(share(panels, 1280, 800), 0.50F);
  EXPECT_GE(share(panels, 1920, 1080), 0.63F);
}

TEST_F(LayoutWindow, PlotsOpenWithTheFirstStep) {
  good("generate annulus");
  EXPECT_FALSE(boxes().contains("plot"));
  EXPECT_TRUE(boxes().contains("timeline"));
  good("step vertex");
  good("move 5 5");
  EXPECT_TRUE(boxes().contains("plot"));
  good("click fold:bottom");
  EXPECT_FALSE(boxes().contains("plot"));
  good("step iteration");
  EXPECT_FALSE(boxes().contains("plot")) << "closed by hand";
  good("generate block");
  EXPECT_FALSE(boxes().contains("plot"));
  good("click fold:bottom");
  EXPECT_TRUE(boxes().contains("plot"));
  good("generate annulus");
  EXPECT_FALSE(boxes().contains("plot"));
  good("plot histogram");
  good("move 5 5");
  EXPECT_TRUE(boxes().contains("plot")) << "of the input there are qualities";
}

TEST_F(LayoutWindow, EdgesAreDraggedAndADoubleClickGivesTheUsualSize) {
  good("generate annulus");
  good("dock setup left");
  good("step iteration");
  const double before = state().panels.left_width;
  const float width = box("viewport")[2] - box("viewport")[0];
  drag("splitter:left", 60, 0);
  EXPECT_NEAR(state().panels.left_width, before + 4.0, 0.1);
  EXPECT_NEAR(box("viewport")[2] - box("viewport")[0], width - 60, 1.5);
  drag("splitter:left", -900, 0);
  const double least = state().panels.left_width;
  EXPECT_GE(least, 10.0) << "as much as its contents need";
  drag("splitter:right", -30, 0);
  EXPECT_NEAR(state().panels.right_width, ui::Panels{}.right_width + 2.0, 0.1);
  drag("splitter:bottom", 0, -30);
  EXPECT_NEAR(state().panels.bottom_height, ui::Panels{}.bottom_height + 2.0, 0.1);
  drag("splitter:runs", 0, 30);
  EXPECT_NEAR(state().panels.runs_height, ui::Panels{}.runs_height + 2.0, 0.1);
  for (const char* edge : {"left", "right", "bottom", "runs"}) {
    const Box at = box(fmt::format("splitter:{}", edge));
    good(fmt::format("double-click {} {}", (at[0] + at[2]) / 2, at[1] + 0.3F * (at[3] - at[1])));
  }
  EXPECT_EQ(state().panels.left_width, ui::Panels{}.left_width);
  EXPECT_EQ(state().panels.right_width, ui::Panels{}.right_width);
  EXPECT_EQ(state().panels.bottom_height, ui::Panels{}.bottom_height);
  EXPECT_EQ(state().panels.runs_height, ui::Panels{}.runs_height);
  good("panel-size left 20");
  EXPECT_EQ(state().panels.left_width, 20.0);
  good("panel-size left default");
  EXPECT_EQ(state().panels.left_width, ui::Panels{}.left_width);
  EXPECT_TRUE(window_->run("panel-size middle 20").has_value());
}

TEST_F(LayoutWindow, AWidthThatWasDraggedIsACommandOfTheLog) {
  good("generate annulus");
  drag("splitter:right", -45, 0);
  EXPECT_NE(state().commands.script({}).find(fmt::format("panel-size right {}", state().panels.right_width).substr(0, 20)),
            std::string::npos)
      << state().commands.script({});
}

TEST_F(LayoutWindow, TabsFoldThePanels) {
  good("generate annulus");
  good("dock setup left");
  good("step iteration");
  const Box before = box("viewport");
  for (const char* panel : {"left", "right", "bottom"}) {
    good(fmt::format("click fold:{}", panel));
    const Box now = box("viewport");
    EXPECT_GT((now[2] - now[0]) * (now[3] - now[1]), (before[2] - before[0]) * (before[3] - before[1]) + 1000) << panel;
    good(fmt::format("click fold:{}", panel));
    EXPECT_EQ(box("viewport"), before) << panel;
  }
}

TEST_F(LayoutWindow, AClickOnPlusMovesNoControl) {
  open(1280, 1400);
  good("generate annulus");
  good("settings on");
  good("step iteration");
  good("move 5 5");
  const auto before = boxes();
  const int grid = session()->runs[0].parameters.search.grid_points;
  // Clicks at one place, as by a person who wants three more: the first click makes a new run.
  const Box plus = box("grid+");
  const std::string click = fmt::format("click {} {}", (plus[0] + plus[2]) / 2, (plus[1] + plus[3]) / 2);
  for (int k = 0; k < 3; ++k) good(click);
  ASSERT_EQ(session()->runs.size(), 2U);
  EXPECT_EQ(session()->runs[1].parameters.search.grid_points, grid + 3);
  good("move 5 5");
  std::size_t same = 0;
  for (const auto& [name, at] : boxes()) {
    // The legend above the plot has two runs now.
    if (name == "minimum") continue;  // a number, whose width varies
    if (name.starts_with("plot") || name.starts_with("legend") || name.starts_with("status") || !before.contains(name)) continue;
    EXPECT_EQ(before.at(name), at) << name;
    ++same;
  }
  EXPECT_GT(same, 60U);
}

TEST_F(LayoutWindow, ButtonsBesideOneWhoseLabelChangesStay) {
  good("generate annulus");
  good("panel bottom on");
  const Box fit = box("fit"), forward = box("timeline-forward"), shown = box("toolbar-shown");
  good("wireframe toggle");
  good("run 3");
  good("seek 0");
  good("speed 0.25");
  EXPECT_EQ(box("fit"), fit);
  EXPECT_EQ(box("timeline-forward"), forward);
  EXPECT_EQ(box("toolbar-shown"), shown);
}

TEST_F(LayoutWindow, MetricNamesHaveTheRoomTheyNeed) {
  good("generate quads 300");
  good("metric mean-ratio-area");  // "Mean ratio by area"
  const Box metric = box("metric");
  EXPECT_GT(metric[2] - metric[0], 9.5F * 15.0F + 23.0F) << "the longest name and the arrow";
  EXPECT_LE(metric[2], 1280.0F);
}

}  // namespace
}  // namespace dmoscope::app
