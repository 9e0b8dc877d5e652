// Plots under the mouse: moving, brushing and reading.
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/gui/plots.h"
#include "ui/plots/plot_drawing.h"
#include "ui/plots/plot_interaction.h"

namespace dmoscope::ui {
namespace {

/// A plot of fixed size and a mouse over it.
class PlotMice : public testing::Test {
 protected:
  void show(PlotTab tab) {
    state_.plot = tab;
    state_.plot_options.x_axis = XAxis::Linear;
    if (tab == PlotTab::Histogram) held_ = smoothed("annulus", 1);
    plot_ = plot_of(state_, held_ ? *held_ : session_);
    lay();
  }
  void lay() { layout_ = *lay_out(plot_, state_.plot_view(), {0, 0, 1000, 300, 15}); }
  PlotOutcome move(double x, double y, const PlotMouse& buttons = {}) {
    PlotMouse mouse = buttons;
    mouse.x = x;
    mouse.y = y;
    mouse.over = true;
    return handle_mouse(mouse, drag_, plot_, state_.plot_view(), layout_, 1.0);
  }
  /// Commands of a press, three moves and a release.
  std::vector<std::string> drag(double x0, double y0, double x1, double y1, bool right = false, bool shift = false) {
    PlotMouse mouse;
    mouse.shift = shift;
    std::vector<std::string> all;
    const auto add = [&](const PlotOutcome& outcome) { all.insert(all.end(), outcome.commands.begin(), outcome.commands.end()); };
    (right ? mouse.right_pressed : mouse.left_pressed) = true;
    (right ? mouse.right_down : mouse.left_down) = true;
    add(move(x0, y0, mouse));
    mouse.right_pressed = mouse.left_pressed = false;
    for (const double t : {0.3, 0.7, 1.0}) add(move(x0 + t * (x1 - x0), y0 + t * (y1 - y0), mouse));
    mouse.right_down = mouse.left_down = false;
    const PlotOutcome end = move(x1, y1, mouse);
    add(end);
    clicked_ = end.clicked;
    return all;
  }
  static std::vector<double> numbers(const std::string& line, std::size_t skip) {
    std::istringstream words(line);
    std::string word;
    for (std::size_t k = 0; k < skip; ++k) words >> word;
    std::vector<double> found;
    for (double value = 0; words >> value;) found.push_back(value);
    return found;
  }

  SessionView session_ = session_of(2, 51);
  std::shared_ptr<const SessionView> held_;
  ViewState state_;
  Plot plot_;
  PlotLayout layout_;
  PlotDrag drag_;
  std::optional<double> clicked_;
};

TEST_F(PlotMice, BrushingTheHistogramFiltersWholeBars) {
  show(PlotTab::Histogram);
  const auto at = [&](double q) { return layout_.left + q * (layout_.right - layout_.left); };
  auto lines = drag(at(0.513), 100, at(0.27), 120);
  EXPECT_EQ(lines, std::vector<std::string>{"filter 0.265625 0.515625"});  // 17 / 64 and 33 / 64
  state_.plot_options.bins = 16;
  show(PlotTab::Histogram);
  lines = drag(at(0.9), 100, at(5.0), 120);
  EXPECT_EQ(lines, std::vector<std::string>{"filter 0.875 1"});
  EXPECT_TRUE(drag(at(0.5), 100, at(0.5) + 1, 100).empty());  // a click brushes nothing
  plot_.brush = Range{0.2, 0.4};
  EXPECT_EQ(drag(at(0.5), 100, at(0.5) + 1, 100), std::vector<std::string>{"filter off"});
}

TEST_F(PlotMice, ARightDragOrOneWithShiftZoomsToItsBox) {
  show(PlotTab::Convergence);
  for (const bool right : {true, false}) {
    const double x0 = layout_.x.place(40), x1 = layout_.x.place(10), y0 = layout_.y.place(0.2), y1 = layout_.y.place(0.6);
    const auto lines = drag(x0, y0, x1, y1, right, !right);
    ASSERT_EQ(lines.size(), 1U);
    ASSERT_TRUE(lines[0].starts_with("plot-zoom box ")) << lines[0];
    const auto ends = numbers(lines[0], 2);
    ASSERT_EQ(ends.size(), 4U);
    EXPECT_NEAR(ends[0], 10, 1e-9);
    EXPECT_NEAR(ends[1], 40, 1e-9);
    EXPECT_NEAR(ends[2], 0.2, 1e-9);
    EXPECT_NEAR(ends[3], 0.6, 1e-9);
  }
  const auto flat = drag(layout_.x.place(10), 100, layout_.x.place(20), 103, true);
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_TRUE(flat[0].starts_with("plot-zoom x ")) << flat[0];
}

TEST_F(PlotMice, TheWheelKeepsTheValueUnderTheCursor) {
  show(PlotTab::Convergence);
  PlotMouse wheel;
  wheel.wheel = 1;
  const double px = layout_.x.place(30);
  auto lines = move(px, 100, wheel).commands;
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_TRUE(lines[0].starts_with("plot-zoom x ")) << lines[0];
  auto ends = numbers(lines[0], 2);
  state_.plot_view().x_range = Range{ends[0], ends[1]};
  EXPECT_NEAR(ends[1] - ends[0], 0.8 * 50, 1e-6);
  lay();
  EXPECT_NEAR(layout_.x.value(px), 30, 1e-6);
  wheel.wheel = -9;  // zooms out again
  EXPECT_EQ(move(px, 100, wheel).commands, std::vector<std::string>{"plot-zoom x all"});
  wheel.wheel = 1;
  const double py = layout_.y.place(0.4);
  lines = move(layout_.left - 20, py, wheel).commands;
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_TRUE(lines[0].starts_with("plot-zoom y ")) << lines[0];
  ends = numbers(lines[0], 2);
  state_.plot_view().y_range = Range{ends[0], ends[1]};
  lay();
  EXPECT_NEAR(layout_.y.value(py), 0.4, 1e-9);
}

TEST_F(PlotMice, ADragMovesWhatIsZoomedAndStaysInside) {
  show(PlotTab::Convergence);
  EXPECT_TRUE(drag(400, 100, 500, 100).empty());
  state_.plot_view().x_range = Range{20, 30};
  lay();
  const double pixels = (layout_.right - layout_.left) / 10.0;  // pixels per iteration
  PlotMouse held;
  held.left_pressed = held.left_down = true;
  EXPECT_TRUE(move(500, 100, held).commands.empty());
  held.left_pressed = false;
  const auto lines = move(500 + 2 * pixels, 100, held).commands;
  ASSERT_EQ(lines.size(), 1U);
  const auto ends = numbers(lines[0], 2);
  EXPECT_NEAR(ends[0], 18, 1e-6);
  EXPECT_NEAR(ends[1], 28, 1e-6);
  const auto far = numbers(move(500 + 200 * pixels, 100, held).commands.at(0), 2);
  EXPECT_NEAR(far[0], 0, 1e-9);
  EXPECT_NEAR(far[1], 10, 1e-6);
}

TEST_F(PlotMice, AClickTellsWhereAndTwiceShowsAll) {
  show(PlotTab::Convergence);
  EXPECT_TRUE(drag(layout_.x.place(12), 100, layout_.x.place(12) + 1, 101).empty());
  ASSERT_TRUE(clicked_);
  EXPECT_NEAR(*clicked_, 12, 0.1);
  PlotMouse twice;
  twice.twice = twice.left_pressed = twice.left_down = true;
  EXPECT_EQ(move(300, 100, twice).commands, std::vector<std::string>{"plot-zoom all"});
  EXPECT_EQ(drag_.kind, PlotDrag::Kind::None);
}

TEST(PlotReading, SaysTheNearestSampleOfEachRunThatReachesThere) {
  SessionView session = session_of(2, 51);
  std::vector<IterationRecord> shorter = session.runs[1].records.whole();
  shorter.resize(11);
  set_records(session.runs[1], std::move(shorter));
  const Plot plot = plot_of(session);
  EXPECT_EQ(read_plot(plot, {}, 10.3).size(), 6U);
  const auto later = read_plot(plot, {}, 30.4);
  ASSERT_EQ(later.size(), 3U);
  for (const Reading& reading : later) {
    EXPECT_EQ(reading.series->run, "1 dmo");
    EXPECT_EQ(reading.series->x[reading.sample], 30.0);
  }
}

}  // namespace
}  // namespace dmoscope::ui
