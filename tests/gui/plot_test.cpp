// Plots as data: what they are made of, how they are read, written and moved by the mouse.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "core/session/engine.h"
#include "ui/derived.h"
#include "ui/plot_drawing.h"
#include "ui/plot_interaction.h"
#include "ui/plot_save.h"
#include "ui/plot_series.h"

namespace dmoscope::ui {
namespace {

const Palette& colours() { return palette(Theme::Light); }

IterationRecord record(std::uint64_t iteration, double minimum, double mean, double seconds) {
  IterationRecord made;
  made.iteration = iteration;
  made.statistics.minimum = minimum;
  made.statistics.mean = mean;
  made.statistics.movable_minimum = minimum + 0.01;
  made.moved = 100 - iteration;
  made.seconds = seconds;
  return made;
}

void set_records(RunView& run, std::vector<IterationRecord> records) {
  run.records = SharedVector<IterationRecord>(std::make_shared<const std::vector<IterationRecord>>(std::move(records)));
}

/// Changes the statistics of one record.
template <class Change>
void change(RunView& run, std::size_t k, Change how) {
  std::vector<IterationRecord> records = run.records.whole();
  how(records.at(k).statistics);
  set_records(run, std::move(records));
}

/// A session without a mesh: its runs' records are all that these plots need.
SessionView session_of(std::size_t runs, std::size_t records) {
  SessionView session;
  for (std::size_t r = 0; r < runs; ++r) {
    RunView run;
    run.title = "run " + std::to_string(r);
    std::vector<IterationRecord> made;
    for (std::size_t k = 0; k < records; ++k) {
      const double t = static_cast<double>(k) + 10.0 * static_cast<double>(r);
      made.push_back(record(k, 0.1 + 0.001 * t, 0.8 + 0.0005 * t, k == 0 ? 0.0 : 0.002 + 0.0001 * t));
    }
    set_records(run, std::move(made));
    session.runs.push_back(std::move(run));
  }
  return session;
}

Plot plot_of(const ViewState& state, const SessionView& session) { return build_plot(state, session, {}, colours()); }

Plot plot_of(const SessionView& session) {
  const auto state = std::make_unique<ViewState>();
  return plot_of(*state, session);
}

const Series& series_named(const Plot& plot, const std::string& run, const std::string& name) {
  for (const Series& one : plot.series) {
    if (one.run == run && one.name == name) return one;
  }
  throw std::out_of_range(run + "/" + name);
}

std::shared_ptr<const SessionView> smoothed(const std::string& mesh, int iterations) {
  Engine engine(1);
  engine.post("generate " + mesh);
  engine.post("run " + std::to_string(iterations));
  engine.wait_idle();
  return engine.view();
}

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
  summary->metric = Metric::MaxAngle;  // of another metric: not beside these
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
  // A tenth of the distance to the ideal is as far wherever it is.
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

// What is in an SVG

struct SvgLine {
  std::string name, dash;
  std::vector<std::pair<double, double>> points;
};
struct SvgText {
  double x, y;
  std::string text;
};

std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(' ' + name + "=\"");
  if (at == std::string::npos) return {};
  const std::size_t from = at + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

/// Lines and texts of an SVG; fails where tags are not balanced.
std::pair<std::vector<SvgLine>, std::vector<SvgText>> read_svg(const std::string& svg) {
  std::vector<SvgLine> lines;
  std::vector<SvgText> texts;
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag[0] == '?') continue;
    if (tag[0] == '/') {
      EXPECT_FALSE(open.empty());
      if (open.empty()) return {};
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
      continue;
    }
    const std::string name = tag.substr(0, tag.find_first_of(" /"));
    const std::string inner = svg.substr(end + 1, svg.find('<', end) - end - 1);
    if (tag.back() != '/') open.push_back(name);
    if (name == "polyline") {
      SvgLine line{{}, attribute(tag, "stroke-dasharray"), {}};
      std::istringstream words(attribute(tag, "points"));
      double x = 0, y = 0;
      char comma = 0;
      while (words >> x >> comma >> y) line.points.emplace_back(x, y);
      lines.push_back(std::move(line));
    } else if (name == "title" && !lines.empty()) {
      lines.back().name = inner;
    } else if (name == "text") {
      texts.push_back({std::stod(attribute(tag, "x")), std::stod(attribute(tag, "y")), inner});
    }
  }
  EXPECT_TRUE(open.empty());
  return {lines, texts};
}

/// value -> place, from two labels of an axis.
double by_labels(const std::vector<SvgText>& texts, const std::string& a, const std::string& b, double SvgText::*along, double value) {
  const auto find = [&](const std::string& text) {
    return std::find_if(texts.begin(), texts.end(), [&](const SvgText& one) { return one.text == text; });
  };
  EXPECT_NE(find(a), texts.end()) << a;
  EXPECT_NE(find(b), texts.end()) << b;
  const double pa = (*find(a)).*along, pb = (*find(b)).*along;
  return pa + (value - std::stod(a)) / (std::stod(b) - std::stod(a)) * (pb - pa);
}

TEST(PlotSvg, HasEveryVisibleSeriesWithAllItsPointsWhereTheLabelsSay) {
  const SessionView session = session_of(2, 101);
  const Plot plot = plot_of(session);
  PlotView view;
  view.hidden = {"mean"};
  const auto [lines, texts] = read_svg(svg_of(whole_plot(plot, view, 900, 600, ink_of(colours()))));
  std::map<std::string, SvgLine> named;
  for (const SvgLine& line : lines) {
    if (line.name.empty()) continue;
    EXPECT_TRUE(named.emplace(line.name, line).second) << line.name << " twice";
  }
  ASSERT_EQ(named.size(), 4U);
  EXPECT_FALSE(named.contains("1 dmo mean"));
  for (std::size_t r = 0; r < 2; ++r) {
    const SvgLine& line = named.at(std::to_string(r + 1) + " dmo minimum");
    ASSERT_EQ(line.points.size(), 101U);
    for (const std::size_t k : {0U, 17U, 50U, 100U}) {
      const double x = by_labels(texts, "20", "80", &SvgText::x, static_cast<double>(k));
      // A label's baseline lies as far below its value as every other's.
      const double shift = 0.36 * 12.0;
      const double y = by_labels(texts, "0.12", "0.20", &SvgText::y, session.runs[r].records[k].statistics.minimum) - shift;
      EXPECT_NEAR(line.points[k].first, x, 0.02);
      EXPECT_NEAR(line.points[k].second, y, 0.05);
    }
  }
  EXPECT_TRUE(named.at("1 dmo minimum").dash.empty());
  EXPECT_FALSE(named.at("1 dmo movable minimum").dash.empty());
}

TEST(PlotSvg, WhatIsZoomedAwayIsCutAtTheFrame) {
  const SessionView session = session_of(1, 101);
  const Plot plot = plot_of(session);
  PlotView view;
  view.x_range = Range{20.25, 60.75};
  view.y_range = Range{0.1295, 0.1505};  // the minimum there: iterations 30 to 50, and halfway to their neighbours
  const auto [lines, texts] = read_svg(svg_of(whole_plot(plot, view, 900, 600, ink_of(colours()))));
  const auto minimum = std::find_if(lines.begin(), lines.end(), [](const SvgLine& line) { return line.name == "minimum"; });
  ASSERT_NE(minimum, lines.end());
  ASSERT_EQ(minimum->points.size(), 23U);
  const double low = by_labels(texts, "0.130", "0.150", &SvgText::y, 0.1295) - 0.36 * 12.0;
  EXPECT_NEAR(minimum->points.front().second, low, 0.05);
  EXPECT_NEAR(minimum->points.front().first, by_labels(texts, "30", "40", &SvgText::x, 29.5), 0.05);
  EXPECT_NEAR(minimum->points.back().first, by_labels(texts, "30", "40", &SvgText::x, 50.5), 0.05);
  for (const SvgLine& line : lines) {
    if (line.name != "mean") continue;
    ADD_FAILURE() << "the mean lies outside";
  }
}

TEST(PlotSvg, GapsSplitALineAndALonePointIsADot) {
  SessionView session = session_of(1, 9);
  for (const std::size_t k : {3U, 5U}) change(session.runs[0], k, [](Statistics& its) { its.mean = NAN; });
  const Plot plot = plot_of(session);
  const Drawing drawing = whole_plot(plot, {}, 800, 450, ink_of(colours()));
  std::vector<std::size_t> parts;
  for (const Drawing::Line& line : drawing.lines) {
    if (line.name == "mean") parts.push_back(line.points.size());
  }
  EXPECT_EQ(parts, (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(drawing.discs.size(), 1U);
}

TEST(PlotSvg, TextIsEscaped) {
  Drawing drawing;
  drawing.width = drawing.height = 10;
  drawing.labels.push_back({{1, 1}, "a < b & \"c\" > d", 12, {}, Drawing::Anchor::Start});
  drawing.lines.push_back({{{0, 0}, {1, 1}}, {}, 1.0, 0.0, "x<y"});
  const std::string svg = svg_of(drawing);
  EXPECT_NE(svg.find("a &lt; b &amp; \"c\" &gt; d"), std::string::npos);
  EXPECT_NE(svg.find("<title>x&lt;y</title>"), std::string::npos);
}

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
    if (line.back() == ',') rows.back().emplace_back();
  }
  return rows;
}

TEST(PlotCsv, HoldsTheRecordsInFull) {
  SessionView session = session_of(2, 30);
  change(session.runs[1], 7, [](Statistics& its) { its.minimum = NAN; });
  PlotView view;
  view.hidden = {"mean", "movable minimum"};
  const auto rows = table_of(plot_csv(plot_of(session), view));
  ASSERT_EQ(rows.size(), 61U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"run", "series", "iteration", "value"}));
  for (std::size_t k = 0; k < 30; ++k) {
    EXPECT_EQ(rows[1 + k][0], "1 dmo");
    EXPECT_EQ(rows[1 + k][1], "minimum");
    EXPECT_EQ(std::stod(rows[1 + k][2]), static_cast<double>(k));
    EXPECT_EQ(std::stod(rows[1 + k][3]), session.runs[0].records[k].statistics.minimum);
  }
  EXPECT_EQ(rows[1 + 30 + 7], (std::vector<std::string>{"2 dmo", "minimum", "7", ""}));
  view.x_range = Range{10, 12};
  EXPECT_EQ(table_of(plot_csv(plot_of(session), view)).size(), 1U + 2 * 3);
}

// The mouse

/// A plot of its own size and a mouse over it.
class PlotMice : public testing::Test {
 protected:
  void show(PlotTab tab) {
    state_.plot = tab;
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
  /// All commands of a press, three moves and a release.
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
  EXPECT_TRUE(drag(at(0.5), 100, at(0.5) + 1, 100).empty());  // a click, and nothing is brushed
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
  wheel.wheel = -9;  // out again
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
  const double pixels = (layout_.right - layout_.left) / 10.0;  // an iteration
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
