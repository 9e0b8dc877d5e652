// First range of plots: it gives most of the width to changes.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/gui/plots.h"
#include "ui/commands/settings.h"
#include "ui/commands/view_json.h"
#include "ui/plots/plot_drawing.h"
#include "ui/plots/plot_interaction.h"
#include "ui/plots/plot_save.h"

namespace dmoscope::ui {
namespace {

constexpr PlotArea kArea{0, 0, 1000, 300, 12};

/// A session with a run of 220 iterations whose minimum rises for 20.
SessionView converged_run() {
  SessionView session = session_of(1, 1);
  std::vector<IterationRecord> records;
  for (std::uint64_t k = 0; k <= 220; ++k) {
    const double t = static_cast<double>(std::min<std::uint64_t>(k, 20));
    records.push_back(record(k, 0.1 + 0.02 * t, 0.8 + 0.001 * t, k == 0 ? 0.0 : 0.01));
  }
  set_records(session.runs[0], std::move(records));
  session.runs[0].moment = {220};
  return session;
}

/// Share of the plot's width up to an iteration.
double share_up_to(const Plot& plot, const PlotView& view, double x) {
  const PlotLayout layout = *lay_out(plot, view, kArea);
  return (layout.x.place(x) - layout.left) / (layout.right - layout.left);
}

TEST(PlotEnds, CurvesAreNamedBesideThePlotIfThereIsRoom) {
  const auto names = [](std::size_t runs, double beside) {
    const Plot plot = plot_of(session_of(runs, 5));
    const PlotLayout layout = lay_out(plot, {}, {0, 0, 400, 200}).value();
    Drawing drawing;
    draw_plot_area(drawing, plot, {}, layout, ink_of(colours()), 12, 1, beside);
    std::vector<std::string> named;
    double last = -1.0;
    for (const Drawing::Label& label : drawing.labels) {
      if (label.at.x < layout.right || label.anchor != Drawing::Anchor::Start) continue;
      EXPECT_GE(label.at.y - last, 12.0) << "no name lies on another";
      last = label.at.y;
      named.push_back(label.text);
    }
    return named;
  };
  EXPECT_EQ(names(1, 0.0), std::vector<std::string>{});
  EXPECT_EQ(names(1, 150.0), (std::vector<std::string>{"mean", "movable minimum", "minimum"}));
  EXPECT_EQ(names(3, 20.0), (std::vector<std::string>{"3", "2", "1"})) << "the numbers of runs need little";
}

TEST(PlotEnds, LabelsOfTheAxisStandBelowTheirTicks) {
  for (const std::size_t records : {2U, 6U, 11U, 201U}) {
    const Plot plot = plot_of(session_of(1, records));
    const PlotLayout layout = lay_out(plot, {}, {0, 0, 400, 200}).value();
    Drawing drawing;
    draw_plot_area(drawing, plot, {}, layout, ink_of(colours()), 12, 1, 0);
    for (const Drawing::Label& label : drawing.labels) {
      if (label.at.y < layout.bottom + 12 || label.text.size() > 2) continue;
      EXPECT_EQ(label.anchor, Drawing::Anchor::Middle) << label.text << " is short, and needs no room behind the end";
      EXPECT_NEAR(label.at.x, layout.x.place(std::stod(label.text)), 1e-6);
    }
  }
}

TEST(PlotEnds, LabelsOfMarksLieOnNoCurve) {
  SessionView session = session_of(1, 11);
  std::vector<IterationRecord> records;
  for (std::uint64_t k = 0; k < 11; ++k) records.push_back(record(k, 0.1, 0.9, 0.01));
  set_records(session.runs[0], std::move(records));
  Plot plot = plot_of(session);
  plot.marks = {{10.0, "mean"}, {9.9, "joint"}};
  const PlotLayout layout = lay_out(plot, {}, {0, 0, 400, 200}).value();
  Drawing drawing;
  draw_plot_area(drawing, plot, {}, layout, ink_of(colours()), 12, 1, 0);
  std::vector<double> baselines;
  for (const Drawing::Label& label : drawing.labels) {
    if (label.text != "mean" && label.text != "joint") continue;
    baselines.push_back(label.at.y);
    for (const double value : {0.1, 0.9}) {
      const double curve = layout.y.place(value);
      EXPECT_TRUE(curve > label.at.y || curve < label.at.y - 8) << label.text << " is crossed at " << value;
    }
  }
  ASSERT_EQ(baselines.size(), 2U);
  EXPECT_GE(std::abs(baselines[0] - baselines[1]), 12.0);
}

TEST(PlotHome, TheRiseHasMostOfTheWidthUnlessAskedOtherwise) {
  const SessionView session = converged_run();
  ViewState state;
  const Plot log = plot_of(state, session);
  EXPECT_GT(share_up_to(log, {}, 20), 0.5);
  EXPECT_EQ(share_up_to(log, {}, 0), 0.0) << "the input has its place";
  EXPECT_NEAR(share_up_to(log, {}, 1), std::log(2.0) / std::log(221.0), 1e-12);
  state.plot_options.x_axis = XAxis::Changes;
  const Plot changes = plot_of(state, session);
  EXPECT_GT(share_up_to(changes, {}, 20), 0.7);
  EXPECT_LT(share_up_to(changes, {}, 20), 1.0);
  EXPECT_EQ(x_extent(changes), (Range{0, 220})) << "from which one can zoom out";
  EXPECT_NE(changes.x_title.find("all: 220"), std::string::npos) << changes.x_title;
  state.plot_options.x_axis = XAxis::Linear;
  EXPECT_NEAR(share_up_to(plot_of(state, session), {}, 20), 20.0 / 220, 1e-12);
}

TEST(PlotHome, SecondsHaveALogarithmFromTheFirstIterationOn) {
  const SessionView session = converged_run();
  ViewState state;
  state.plot_options.by_seconds = true;
  const Plot plot = plot_of(state, session);
  EXPECT_NEAR(share_up_to(plot, {}, 0.01), std::log(2.0) / std::log(221.0), 1e-6);
  EXPECT_GT(share_up_to(plot, {}, 0.2), 0.5);
}

TEST(PlotHome, PlacesAndValuesAreEachOthersInverse) {
  const PlotLayout layout = *lay_out(plot_of(converged_run()), {}, kArea);
  for (const double x : {0.0, 0.5, 1.0, 17.0, 220.0}) EXPECT_NEAR(layout.x.value(layout.x.place(x)), x, 1e-9 * (1.0 + x));
}

TEST(PlotHome, TheLogarithmicAxisIsLabelledFromZeroInOnesTwosAndFives) {
  const Plot plot = plot_of(converged_run());
  const PlotLayout layout = *lay_out(plot, {}, kArea);
  std::vector<std::string> labels;
  double last = -1e9;
  for (const PlacedTick& tick : place_ticks(layout.x, plot.x_unit, true, 14)) {
    labels.push_back(tick.label);
    EXPECT_GT(tick.place - last, 40.0) << tick.label << ": labels have room";
    last = tick.place;
  }
  EXPECT_EQ(labels, (std::vector<std::string>{"0", "1", "2", "5", "10", "20", "50", "100", "200"}));
}

TEST(PlotHome, NoPeakOfManyIterationsIsLostInALogarithmicPlot) {
  SessionView session = session_of(1, 1);
  std::vector<IterationRecord> records;
  for (std::uint64_t k = 0; k <= 20'000; ++k) records.push_back(record(k, k == 3 ? 0.9 : 0.5, 0.95, 0.01));
  set_records(session.runs[0], std::move(records));
  const Plot plot = plot_of(session);
  const PlotLayout layout = *lay_out(plot, {}, kArea);
  Drawing drawing;
  draw_plot_area(drawing, plot, {}, layout, ink_of(colours()), 12, 1);
  const double top = layout.y.place(0.9), at = layout.x.place(3);
  double before = 0.0, peak = 0.0;
  for (const Drawing::Line& line : drawing.lines) {
    for (const Drawing::Point& p : line.points) {
      if (std::abs(p.y - top) < 0.01 && std::abs(p.x - at) < 0.01) peak = p.x;
      if (std::abs(p.x - layout.x.place(2)) < 0.01) before = p.x;
    }
  }
  EXPECT_GT(peak, 0.0) << "the peak is at its place";
  EXPECT_GT(before, 0.0) << "and so is what comes before it: they are far apart on this axis";
}

TEST(PlotHome, DraggingALogarithmicPlotKeepsItsWidthOnTheScreen) {
  const Plot plot = plot_of(converged_run());
  PlotView view;
  view.x_range = Range{5, 50};
  const PlotLayout layout = *lay_out(plot, view, kArea);
  PlotDrag drag;
  PlotMouse mouse;
  mouse.over = true;
  mouse.x = 500;
  mouse.y = 100;
  mouse.left_pressed = mouse.left_down = true;
  (void)handle_mouse(mouse, drag, plot, view, layout, 1.0);
  mouse.left_pressed = false;
  mouse.x = 400;
  const auto commands = handle_mouse(mouse, drag, plot, view, layout, 1.0).commands;
  ASSERT_EQ(commands.size(), 1U);
  double low = 0, high = 0;
  ASSERT_EQ(std::sscanf(commands[0].c_str(), "plot-zoom x %lf %lf", &low, &high), 2) << commands[0];
  EXPECT_NEAR((1 + high) / (1 + low), 51.0 / 6.0, 1e-9);
  EXPECT_NEAR(low, layout.x.value(layout.left + 100), 1e-9);
}

TEST(PlotHome, ARightClickAsksForTheMenuAndARightDragDoesNot) {
  const Plot plot = plot_of(converged_run());
  const PlotLayout layout = *lay_out(plot, {}, kArea);
  for (const double to : {500.0, 700.0}) {
    PlotDrag drag;
    PlotMouse mouse;
    mouse.over = mouse.right_pressed = mouse.right_down = true;
    mouse.x = 500;
    mouse.y = 100;
    EXPECT_FALSE(handle_mouse(mouse, drag, plot, {}, layout, 1.0).menu);
    mouse.right_pressed = mouse.right_down = false;
    mouse.x = to;
    EXPECT_EQ(handle_mouse(mouse, drag, plot, {}, layout, 1.0).menu, to == 500.0);
  }
}

/// A session with a histogram of these elements.
SessionView histogram_session(const std::vector<std::pair<std::size_t, Index>>& bins) {
  SessionView session = session_of(1, 1);
  auto frame = std::make_shared<Frame>();
  for (const auto& [bin, elements] : bins) frame->now.counts[bin] = elements;
  frame->before = frame->now;
  session.frame = frame;
  return session;
}

TEST(PlotHome, TheHistogramBeginsWhereItsElementsAre) {
  ViewState state;
  state.plot = PlotTab::Histogram;
  const Plot plot = plot_of(state, histogram_session({{42, 10}, {50, 500}, {63, 900}}));
  ASSERT_TRUE(plot.x_home);
  EXPECT_EQ(*plot.x_home, (Range{41.0 / 64, 1.0})) << "a bar of room";
  EXPECT_EQ(x_extent(plot), (Range{0, 1}));
  EXPECT_EQ(plot.y_title, "elements") << "nothing is left out";
  state.plot_options.histogram_range = HistogramRange::Whole;
  EXPECT_FALSE(plot_of(state, histogram_session({{42, 10}, {63, 900}})).x_home);
}

TEST(PlotHome, AFewElementsFarDownAreLeftOutAndSaid) {
  ViewState state;
  state.plot = PlotTab::Histogram;
  const Plot plot = plot_of(state, histogram_session({{1, 2}, {8, 1}, {45, 4000}, {63, 9000}}));
  ASSERT_TRUE(plot.x_home);
  EXPECT_EQ(*plot.x_home, (Range{44.0 / 64, 1.0}));
  EXPECT_NE(plot.y_title.find("3 below 0.688"), std::string::npos) << plot.y_title;
  const Plot many = plot_of(state, histogram_session({{1, 200}, {45, 4000}, {63, 9000}}));
  EXPECT_FALSE(many.x_home) << "so many are not left out";
}

TEST(PlotHome, FilesHaveWhatIsSeen) {
  ViewState state;
  state.plot = PlotTab::Histogram;
  const std::string seen = plot_csv(plot_of(state, histogram_session({{42, 10}, {63, 900}})), {});
  EXPECT_EQ(std::ranges::count(seen, '\n'), 1 + 24) << "bars from 40 / 64, which ends where the plot begins, to the last";
  state.plot = PlotTab::Convergence;
  state.plot_options.x_axis = XAxis::Changes;
  const SessionView session = converged_run();
  const Plot plot = plot_of(state, session);
  const std::string rows = plot_csv(plot, {});
  EXPECT_NE(rows.find(",minimum,20,"), std::string::npos);
  EXPECT_EQ(rows.find(",minimum,60,"), std::string::npos);
  const std::string svg = svg_of(whole_plot(plot_of(session), {}, 800, 450, ink_of(colours())));
  for (const char* tick : {">0<", ">1<", ">10<", ">100<"}) EXPECT_NE(svg.find(tick), std::string::npos) << tick;
}

TEST(PlotHome, TheChoiceIsRemembered) {
  ViewState state, again, other;
  EXPECT_EQ(state.plot_options.x_axis, XAxis::Log);
  state.plot_options.x_axis = XAxis::Changes;
  state.plot_options.histogram_range = HistogramRange::Whole;
  ASSERT_TRUE(apply_settings(settings_text(state), again));
  EXPECT_EQ(again.plot_options, state.plot_options);
  apply_view_json(view_json(state), other, nullptr);
  EXPECT_EQ(other.plot_options, state.plot_options);
  ASSERT_TRUE(apply_settings(R"({"x_axis": "sideways", "histogram_range": 3})", again));
  EXPECT_EQ(again.plot_options, state.plot_options) << "nonsense changes nothing";
}

}  // namespace
}  // namespace dmoscope::ui
