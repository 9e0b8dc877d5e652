#include "app/common/line_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/drawing/ticks.h"

namespace dmoscope::app {
namespace {

// Colours that differ also for the colour-blind (after Okabe and Ito); the pale yellow of that set is left out.
constexpr std::array<DrawingColour, 8> kColours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {120, 80, 40}, {70, 70, 160}}};
constexpr std::array<double, 4> kDashes{0.0, 7.0, 13.0, 3.0};
constexpr DrawingColour kInk{40, 40, 40}, kFaint{110, 110, 110}, kGrid{200, 200, 200}, kFineGrid{232, 232, 232};

constexpr double kPlotWidth = 620.0, kLeast = 380.0;  // size of the frame, which grows with the legend
constexpr double kLeft = 70.0, kTop = 92.0, kBottom = 84.0, kGap = 24.0;
constexpr double kRow = 21.0, kSample = 34.0, kText = 12.0;
constexpr double kWidthOfALetter = 0.62 * kText;  // upper bound for DejaVu Sans, which is wider than other fonts

std::string axis_number(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  return value >= 1e3 ? fmt::format("{:g} k", value / 1e3) : fmt::format("{:g}", value);
}

bool drawable(double value, AxisKind kind) { return std::isfinite(value) && (kind == AxisKind::Linear || value > 0.0); }

/// Maps values to places along an axis.
class Axis {
 public:
  Axis(AxisKind kind, double lowest, double highest, double start, double end)
      : kind_(kind), low_(along(lowest)), high_(along(highest)), start_(start), end_(end) {
    // Room at both ends. A logarithmic axis spans at least a decade, so that there are two labels even for a single value; a linear one is
    // never empty.
    const double span = high_ - low_;
    const double least = kind == AxisKind::Logarithmic ? 0.5 * (1.0 - span) : span > 0.0 ? 0.0 : std::max(0.5 * std::abs(low_), 1e-3);
    const double widen = std::max((kind == AxisKind::Logarithmic ? 0.08 : 0.03) * span, least);
    low_ -= widen;
    high_ += widen;
  }
  [[nodiscard]] AxisKind kind() const noexcept { return kind_; }
  [[nodiscard]] double place(double value) const { return start_ + (along(value) - low_) / (high_ - low_) * (end_ - start_); }

  /// Calls tick(place, label); the label of a fine line is empty.
  template <class Name, class Tick>
  void for_ticks(Name name, Tick tick) const {
    if (kind_ == AxisKind::Linear) {
      for (const auto& [value, label] : linear_ticks(low_, high_, 8)) tick(place(value), std::abs(value) >= 1e3 ? name(value) : label);
    } else {
      for_powers([&](double value, bool labelled) { tick(place(value), labelled ? name(value) : std::string()); });
    }
  }

 private:
  [[nodiscard]] double along(double value) const { return kind_ == AxisKind::Logarithmic ? std::log10(value) : value; }

  /// Calls tick(value, labelled) for 1 to 9 times every power of ten on the axis.
  template <class Tick>
  void for_powers(Tick tick) const {
    const bool many = high_ - low_ > 2.0;
    for (int power = static_cast<int>(std::floor(low_)); power <= static_cast<int>(std::floor(high_)); ++power) {
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
        const double at = std::log10(value);
        if (at < low_ || at > high_) continue;
        tick(value, digit == 1 || (!many && (digit == 2 || digit == 5)));
      }
    }
  }

  AxisKind kind_;
  double low_, high_, start_, end_;
};

struct Frame {
  double left, right, top, bottom;
  Axis x, y;
};

bool drawable(const PlotValue& v, const LinePlot& plot) {
  return drawable(v.x, plot.x_axis) && drawable(v.y, plot.y_axis) && drawable(v.lowest, plot.y_axis) && drawable(v.highest, plot.y_axis);
}

double raised(double y, const LinePlot& plot) { return plot.y_lowest ? std::max(y, *plot.y_lowest) : y; }

Frame frame_of(const LinePlot& plot) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double left = kInfinity, right = -kInfinity, low = kInfinity, high = -kInfinity;
  std::size_t named = 0;
  for (const PlotSeries& series : plot.series) {
    named += series.name.empty() ? 0 : 1;
    for (const PlotValue& v : series.values) {
      if (!drawable(v, plot)) continue;
      left = std::min(left, v.x);
      right = std::max(right, v.x);
      low = std::min(low, raised(v.lowest, plot));
      high = std::max(high, raised(v.highest, plot));
    }
  }
  if (left > right) left = low = 1.0, right = high = 10.0;  // nothing to draw
  const double height = std::max(kLeast, kRow * static_cast<double>(named));
  const double x0 = kLeft, x1 = kLeft + kPlotWidth, y0 = kTop, y1 = kTop + height;
  return {x0, x1, y0, y1, Axis(plot.x_axis, left, right, x0, x1), Axis(plot.y_axis, low, high, y1, y0)};
}

void draw_axes(Drawing& drawing, const LinePlot& plot, const Frame& f) {
  f.x.for_ticks(axis_number, [&](double x, const std::string& label) {
    drawing.rules.push_back({{{x, f.top}, {x, f.bottom}}, label.empty() ? kFineGrid : kGrid, 1.0});
    if (!label.empty()) drawing.labels.push_back({{x, f.bottom + 18.0}, label, kText, kInk, Drawing::Anchor::Middle});
  });
  const auto plain = [](double value) { return fmt::format("{:g}", value); };
  f.y.for_ticks(plain, [&](double y, const std::string& label) {
    drawing.rules.push_back({{{f.left, y}, {f.right, y}}, label.empty() ? kFineGrid : kGrid, 1.0});
    if (!label.empty()) drawing.labels.push_back({{f.left - 8.0, y + 4.0}, label, kText, kInk, Drawing::Anchor::End});
  });
  const std::vector<Drawing::Point> box{{f.left, f.top}, {f.right, f.top}, {f.right, f.bottom}, {f.left, f.bottom}, {f.left, f.top}};
  drawing.rules.push_back({box, kFaint, 1.0});
  drawing.labels.push_back({{16.0, 30.0}, plot.title, 17.0, kInk});
  drawing.labels.push_back({{16.0, 50.0}, plot.subtitle, kText, kFaint});
  drawing.labels.push_back({{16.0, f.top - 12.0}, plot.y_title, kText + 1.0, kInk});
  drawing.labels.push_back({{16.0, f.bottom + 68.0}, plot.note, kText, kFaint});
  drawing.labels.push_back({{0.5 * (f.left + f.right), f.bottom + 44.0}, plot.x_title, kText + 1.0, kInk, Drawing::Anchor::Middle});
}

DrawingColour colour_of(const PlotSeries& series) { return series.muted ? kFaint : kColours[series.colour % kColours.size()]; }

void draw_series(Drawing& drawing, const LinePlot& plot, const PlotSeries& series, const Frame& f) {
  constexpr double kNear = 0.4;  // distance below which points of a line without dots look the same
  const DrawingColour colour = colour_of(series);
  std::vector<Drawing::Point> points;
  const auto finish = [&] {
    if (points.size() > 1) drawing.lines.push_back({points, colour, series.width, kDashes[series.dash % kDashes.size()]});
    points.clear();
  };
  for (const PlotValue& v : series.values) {
    if (!drawable(v, plot)) {
      finish();
      continue;
    }
    const Drawing::Point p{f.x.place(v.x), f.y.place(raised(v.y, plot))};
    const bool is_last = &v == &series.values.back();
    if (series.dots || is_last || points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) > kNear) points.push_back(p);
    if (!series.dots) continue;
    drawing.lines.push_back({{{p.x, f.y.place(raised(v.lowest, plot))}, {p.x, f.y.place(raised(v.highest, plot))}}, colour, 1.2});
    drawing.discs.push_back({p, 3.2, colour});
  }
  finish();
}

void draw_legend(Drawing& drawing, const LinePlot& plot, const Frame& f) {
  const double x = f.right + kGap;
  double y = f.top + 0.5 * kRow;
  for (const PlotSeries& series : plot.series) {
    if (series.name.empty()) continue;
    const DrawingColour colour = colour_of(series);
    drawing.lines.push_back({{{x, y}, {x + kSample, y}}, colour, std::max(series.width, 1.8), kDashes[series.dash % kDashes.size()]});
    if (series.dots) drawing.discs.push_back({{x + 0.5 * kSample, y}, 3.2, colour});
    drawing.labels.push_back({{x + kSample + 8.0, y + 4.0}, series.name, kText, kInk});
    y += kRow;
  }
}

}  // namespace

Drawing draw(const LinePlot& plot) {
  std::size_t letters = 0;
  for (const PlotSeries& series : plot.series) letters = std::max(letters, series.name.size());
  const Frame frame = frame_of(plot);
  Drawing drawing;
  const double legend = kGap + kSample + 8.0 + kWidthOfALetter * static_cast<double>(letters);
  // The lines above and below may be wider than the plot with its legend.
  const double line = 16.0 + kWidthOfALetter * static_cast<double>(std::max(plot.subtitle.size(), plot.note.size()));
  drawing.width = std::ceil(std::max(frame.right + legend, line) + 16.0);
  drawing.height = std::ceil(frame.bottom + kBottom);
  draw_axes(drawing, plot, frame);
  for (const bool muted : {true, false}) {
    for (auto series = plot.series.rbegin(); series != plot.series.rend(); ++series)
      if (series->muted == muted) draw_series(drawing, plot, *series, frame);
  }
  draw_legend(drawing, plot, frame);
  return drawing;
}

Drawing stacked(Drawing upper, const Drawing& lower) {
  const double down = upper.height;
  const auto take = [down](auto& list, const auto& more, const auto& move) {
    for (auto item : more) {
      move(item, down);
      list.push_back(std::move(item));
    }
  };
  const auto line = [](Drawing::Line& l, double y) {
    for (Drawing::Point& p : l.points) p.y += y;
  };
  take(upper.rules, lower.rules, line);
  take(upper.lines, lower.lines, line);
  take(upper.boxes, lower.boxes, [](Drawing::Box& b, double y) { b.from.y += y, b.to.y += y; });
  take(upper.discs, lower.discs, [](Drawing::Disc& d, double y) { d.centre.y += y; });
  take(upper.labels, lower.labels, [](Drawing::Label& l, double y) { l.at.y += y; });
  upper.width = std::max(upper.width, lower.width);
  upper.height += lower.height;
  return upper;
}

}  // namespace dmoscope::app
