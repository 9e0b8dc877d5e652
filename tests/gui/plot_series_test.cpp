// Plots as data: their series, and the places of values.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "tests/gui/plots.h"
#include "ui/plots/plot_drawing.h"

namespace dmoscope::ui {
namespace {

TEST(PlotSeries, ConvergenceIsTheRecordsAndInfinityIsAGap) {
  SessionView session = session_of(1, 6);
  change(session.runs[0], 2, [](Statistics& its) { its.movable_minimum = INFINITY; });
  change(session.runs[0], 4, [](Statistics& its) { its.inverted = 3; });
  const Plot plot = plot_of(session);
  const Series& minimum = series_named(plot, "", "minimum");
  const Series& movable = series_named(plot, "", "movable minimum");
  const Series& inverted = series_named(plot, "", "inverted");
  ASSERT_EQ(minimum.x.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(minimum.x[k], static_cast<double>(k));
    EXPECT_EQ(minimum.y[k], session.runs[0].records[k].statistics.minimum);
    EXPECT_EQ(inverted.y[k], k == 4 ? 3.0 : 0.0);
    EXPECT_EQ(std::isnan(movable.y[k]), k == 2);
  }
  EXPECT_TRUE(inverted.strip);
  EXPECT_FALSE(minimum.strip);
}

TEST(PlotSeries, SecondsAddUp) {
  const SessionView session = session_of(1, 5);
  ViewState state;
  state.plot_options.by_seconds = true;
  const Plot plot = plot_of(state, session);
  const Series& minimum = series_named(plot, "", "minimum");
  const auto& records = session.runs[0].records;
  EXPECT_EQ(minimum.x[0], 0.0);
  EXPECT_DOUBLE_EQ(minimum.x[3], records[1].seconds + records[2].seconds + records[3].seconds);
  EXPECT_EQ(iteration_at(session.runs[0], true, minimum.x[3] + 1e-5), 3U);
  EXPECT_EQ(iteration_at(session.runs[0], false, 2.4), 2U);
  EXPECT_EQ(iteration_at(session.runs[0], false, 1e9), 4U);
}

TEST(PlotSeries, EveryRunIsInEveryCourse) {
  const SessionView session = session_of(3, 4);
  ViewState state;
  for (const PlotTab tab : {PlotTab::Convergence, PlotTab::Moved, PlotTab::Time}) {
    state.plot = tab;
    const Plot plot = plot_of(state, session);
    for (std::size_t r = 0; r < 3; ++r) {
      const std::string name = std::to_string(r + 1) + " dmo";
      const auto its = std::find_if(plot.series.begin(), plot.series.end(), [&](const Series& one) { return one.run == name; });
      ASSERT_NE(its, plot.series.end()) << name;
      EXPECT_EQ(its->colour, colours().runs[r]);
    }
  }
  state.plot = PlotTab::Moved;
  const Plot plot = plot_of(state, session);
  const Series& moved = series_named(plot, "2 dmo", "");
  EXPECT_EQ(moved.x, (std::vector<double>{1, 2, 3}));  // the input moved nothing
  EXPECT_EQ(moved.y, (std::vector<double>{99, 98, 97}));
}

TEST(PlotSeries, TheLegendHidesAndIsolatesRunsAndQuantities) {
  const Plot plot = plot_of(session_of(3, 4));
  const auto visible = [&](const PlotView& view) {
    std::set<std::string> names;
    for (const Series& one : plot.series) {
      if (is_visible(plot, view, one)) names.insert(full_name(plot, one));
    }
    return names;
  };
  PlotView view;
  EXPECT_EQ(visible(view).size(), 9U);
  view.hidden = {"2 dmo", "mean"};
  EXPECT_EQ(visible(view), (std::set<std::string>{"1 dmo minimum", "1 dmo movable minimum", "3 dmo minimum", "3 dmo movable minimum"}));
  view.isolated = "2 dmo";
  EXPECT_EQ(visible(view), (std::set<std::string>{"2 dmo minimum", "2 dmo movable minimum"}));
  view.isolated = "mean";
  EXPECT_EQ(visible(view), (std::set<std::string>{"1 dmo mean", "3 dmo mean"}));
  view.isolated = "no longer there";
  EXPECT_EQ(visible(view).size(), 4U);
}

TEST(PlotSeries, HistogramBinsAreTheElementsInThem) {
  const auto session = smoothed("random 900", 3);
  const Frame& frame = *session->frame;
  ViewState state;
  state.plot = PlotTab::Histogram;
  for (const int bins : {16, 32, 64}) {
    state.plot_options.bins = bins;
    const Plot plot = plot_of(state, *session);
    const Series& now = series_named(plot, "", "now");
    ASSERT_EQ(now.x.size(), static_cast<std::size_t>(bins));
    std::vector<double> counted(now.x.size(), 0.0);
    const QualityContext context = frame.input->quality_context();
    for (Index e = 0; e < frame.element_count(); ++e) {
      const double q = element_quality(context, frame.positions, frame.shown, e);
      counted[std::min(counted.size() - 1, static_cast<std::size_t>(q * bins))] += 1.0;
    }
    EXPECT_EQ(now.y, counted);
    EXPECT_DOUBLE_EQ(now.x[1] - now.x[0], 1.0 / bins);
    EXPECT_DOUBLE_EQ(now.bar_width, 1.0 / bins);
  }
}

TEST(PlotSeries, PercentilesAreShownWhereTheyAreKnown) {
  SessionView session = session_of(2, 4);
  std::vector<Percentiles> known(4);
  known[1] = {0.2, 0.3, 0.9};
  known[3] = {0.25, 0.35, 0.95};
  session.runs[1].percentiles = SharedVector<Percentiles>(std::make_shared<const std::vector<Percentiles>>(known));
  const Plot plot = plot_of(session);
  const Series& fifth = series_named(plot, "2 dmo", "worst 5 %");
  ASSERT_EQ(fifth.y.size(), 4U);
  EXPECT_TRUE(std::isnan(fifth.y[0]) && std::isnan(fifth.y[2]));
  EXPECT_EQ(fifth.y[1], 0.3);
  EXPECT_EQ(fifth.y[3], 0.35);
  EXPECT_EQ(series_named(plot, "2 dmo", "median").y[3], 0.95);
  EXPECT_EQ(series_named(plot, "2 dmo", "worst 1 %").y[1], 0.2);
  EXPECT_THROW((void)series_named(plot, "1 dmo", "median"), std::out_of_range);
}

TEST(PlotSeries, OtherRunsShowTheirSummariesOfTheShownMetric) {
  SessionView session = *smoothed("annulus", 2);
  session.runs.push_back(session.runs[0]);
  auto summary = std::make_shared<RunSummary>();
  summary->metric = session.frame->shown;
  summary->histogram.counts[63] = 7;
  summary->sorted = {0.25F, 0.5F, 1.0F};
  session.runs[1].summary = summary;
  const auto state = std::make_unique<ViewState>();
  state->plot = PlotTab::Histogram;
  const Plot histogram = plot_of(*state, session);
  EXPECT_EQ(series_named(histogram, "2 dmo", "now").y.back(), 7.0);
  EXPECT_EQ(series_named(histogram, "1 dmo", "now").y.size(), 64U);
  state->plot = PlotTab::Sorted;
  const std::vector<double> own{0.1, 0.2};
  const Plot sorted = build_plot(*state, session, {own, own}, colours());
  EXPECT_EQ(series_named(sorted, "2 dmo", "now").y, (std::vector<double>{0.25, 0.5, 1.0}));
  EXPECT_EQ(series_named(sorted, "2 dmo", "now").x, (std::vector<double>{0, 50, 100}));
  summary->metric = Metric::MaxAngle;  // another metric, which is not plotted beside these
  EXPECT_THROW((void)series_named(plot_of(*state, session), "2 dmo", "now"), std::out_of_range);
}

TEST(PlotSeries, SortedQualitiesGoFromTheWorstToTheBestElement) {
  const auto session = smoothed("annulus", 2);
  ViewState state;
  state.plot = PlotTab::Sorted;
  Derived derived;
  refresh(derived, state, *session);
  const Plot plot = build_plot(state, *session, {derived.sorted_before, derived.sorted_now}, colours());
  std::vector<double> expected(session->frame->quality.begin(), session->frame->quality.end());
  std::sort(expected.begin(), expected.end());
  const Series& now = series_named(plot, "", "now");
  EXPECT_EQ(now.y, expected);
  EXPECT_EQ(now.x.front(), 0.0);
  EXPECT_EQ(now.x.back(), 100.0);
  EXPECT_NEAR(now.x[expected.size() / 2], 50.0, 100.0 / static_cast<double>(expected.size()));
  EXPECT_EQ(series_named(plot, "", "input").y.size(), expected.size());
}

TEST(PlotLayout, PlacesAndValuesAreInverse) {
  for (const auto& [kind, low, high] :
       {std::tuple{ValueAxis::Linear, -1.0, 1.0}, {ValueAxis::Log, 1e-3, 20.0}, {ValueAxis::LogDistance, 0.2, 0.9999}}) {
    const Axis axis{low, high, 400.0, 20.0, kind};
    EXPECT_NEAR(axis.place(low), 400.0, 1e-9);
    EXPECT_NEAR(axis.place(high), 20.0, 1e-9);
    for (const double t : {0.1, 0.5, 0.9}) EXPECT_NEAR(axis.place(axis.value(400.0 - 380.0 * t)), 400.0 - 380.0 * t, 1e-6);
  }
  // A tenth of the distance to the ideal is equally long everywhere.
  const Axis distance{0.0, 0.999, 300.0, 0.0, ValueAxis::LogDistance};
  EXPECT_NEAR(distance.place(0.9) - distance.place(0.99), distance.place(0.0) - distance.place(0.9), 1e-9);
  EXPECT_LT(distance.place(0.99), distance.place(0.9));  // better is higher
}

TEST(PlotLayout, RangesCoverWhatIsVisibleAndOnlyThat) {
  Plot plot;
  plot.series.resize(2);
  plot.series[0].name = "a";
  plot.series[0].x = {0, 1, 2, 3};
  plot.series[0].y = {0.5, NAN, 0.7, -2.0};
  plot.series[1].name = "b";
  plot.series[1].x = {0, 1, 2, 3};
  plot.series[1].y = {100, 200, 300, 400};
  PlotView view;
  view.hidden = {"b"};
  const auto all = value_range(plot, view, {0, 3});
  ASSERT_TRUE(all);
  EXPECT_LT(all->first, -2.0);
  EXPECT_GT(all->first, -2.5);
  EXPECT_GT(all->second, 0.7);
  EXPECT_LT(all->second, 1.0);
  plot.axis = ValueAxis::Log;  // -2 cannot be shown
  const auto logarithmic = value_range(plot, view, {0, 3});
  EXPECT_GT(logarithmic->first, 0.4);
  EXPECT_LT(logarithmic->second, 0.8);
  view.hidden = {"a", "b"};
  EXPECT_FALSE(value_range(plot, view, {0, 3}));
}

}  // namespace
}  // namespace dmoscope::ui
