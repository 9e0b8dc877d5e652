// Plots as files: SVG and CSV.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/gui/plots.h"
#include "ui/plots/plot_drawing.h"
#include "ui/plots/plot_save.h"

namespace dmoscope::ui {
namespace {

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

/// Function from value to place, from two labels of an axis.
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
  const Plot plot = even_plot_of(session);
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
      // Every label's baseline lies equally far below its value.
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
  const Plot plot = even_plot_of(session);
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
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; d"), std::string::npos);
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

}  // namespace
}  // namespace dmoscope::ui
