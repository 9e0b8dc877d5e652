#include "app/line_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace dmoscope::app {
namespace {

// Told apart also by those who see fewer colours (after Okabe and Ito); the pale yellow of that set is left out.
constexpr std::array<DrawingColour, 8> kColours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {120, 80, 40}, {70, 70, 160}}};
constexpr std::array<double, 4> kDashes{0.0, 7.0, 13.0, 3.0};
constexpr DrawingColour kInk{40, 40, 40}, kFaint{110, 110, 110}, kGrid{200, 200, 200}, kFineGrid{232, 232, 232};

constexpr double kPlotWidth = 620.0, kLeast = 380.0;  // of the frame; it grows with the legend
constexpr double kLeft = 70.0, kTop = 92.0, kBottom = 84.0, kGap = 24.0;
constexpr double kRow = 21.0, kSample = 34.0, kText = 12.0;
constexpr double kWidthOfALetter = 0.62 * kText;  // of DejaVu Sans, generously: other fonts are narrower

std::string short_number(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  return value >= 1e3 ? fmt::format("{:g} k", value / 1e3) : fmt::format("{:g}", value);
}

/// Where a value is along its axis.
class LogAxis {
 public:
  LogAxis(double lowest, double highest, double start, double end)
      : low_(std::log10(lowest)), high_(std::log10(highest)), start_(start), end_(end) {
    // At least a decade, so that there are two labels even for a single value; and room at both ends.
    const double widen = std::max(0.08 * (high_ - low_), 0.5 * (1.0 - (high_ - low_)));
    low_ -= widen;
    high_ += widen;
  }
  [[nodiscard]] double place(double value) const { return start_ + (std::log10(value) - low_) / (high_ - low_) * (end_ - start_); }

  /// Calls tick(value, labelled) for 1 to 9 times every power of ten inside.
  template <class Tick>
  void for_ticks(Tick tick) const {
    const bool many = high_ - low_ > 2.0;
    for (int power = static_cast<int>(std::floor(low_)); power <= static_cast<int>(std::floor(high_)); ++power) {
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
        const double place = std::log10(value);
        if (place < low_ || place > high_) continue;
        tick(value, digit == 1 || (!many && (digit == 2 || digit == 5)));
      }
    }
  }

 private:
  double low_, high_, start_, end_;
};

struct Frame {
  double left, right, top, bottom;
  LogAxis x, y;
};

Frame frame_of(const LinePlot& plot) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double left = kInfinity, right = 0.0, low = kInfinity, high = 0.0;
  for (const PlotSeries& series : plot.series) {
    for (const PlotValue& v : series.values) {
      left = std::min(left, v.x);
      right = std::max(right, v.x);
      low = std::min(low, v.lowest);
      high = std::max(high, v.highest);
    }
  }
  if (!(left > 0.0 && low > 0.0 && right < kInfinity && high < kInfinity)) left = low = 1.0, right = high = 10.0;
  const double height = std::max(kLeast, kRow * static_cast<double>(plot.series.size()));
  const double x0 = kLeft, x1 = kLeft + kPlotWidth, y0 = kTop, y1 = kTop + height;
  return {x0, x1, y0, y1, LogAxis(left, right, x0, x1), LogAxis(low, high, y1, y0)};
}

void draw_axes(Drawing& drawing, const LinePlot& plot, const Frame& f) {
  f.x.for_ticks([&](double value, bool labelled) {
    const double x = f.x.place(value);
    drawing.rules.push_back({{{x, f.top}, {x, f.bottom}}, labelled ? kGrid : kFineGrid, 1.0});
    if (labelled) drawing.labels.push_back({{x, f.bottom + 18.0}, short_number(value), kText, kInk, Drawing::Anchor::Middle});
  });
  f.y.for_ticks([&](double value, bool labelled) {
    const double y = f.y.place(value);
    drawing.rules.push_back({{{f.left, y}, {f.right, y}}, labelled ? kGrid : kFineGrid, 1.0});
    if (labelled) drawing.labels.push_back({{f.left - 8.0, y + 4.0}, fmt::format("{:g}", value), kText, kInk, Drawing::Anchor::End});
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

void draw_series(Drawing& drawing, const PlotSeries& series, const Frame& f) {
  const DrawingColour colour = colour_of(series);
  std::vector<Drawing::Point> points;
  for (const PlotValue& v : series.values) {
    if (!(v.x > 0.0 && v.lowest > 0.0 && std::isfinite(v.highest))) continue;
    const Drawing::Point p{f.x.place(v.x), f.y.place(v.y)};
    points.push_back(p);
    drawing.lines.push_back({{{p.x, f.y.place(v.lowest)}, {p.x, f.y.place(v.highest)}}, colour, 1.2});
    drawing.discs.push_back({p, 3.2, colour});
  }
  if (points.size() > 1) drawing.lines.push_back({std::move(points), colour, 1.8, kDashes[series.dash % kDashes.size()]});
}

void draw_legend(Drawing& drawing, const LinePlot& plot, const Frame& f) {
  const double x = f.right + kGap;
  double y = f.top + 0.5 * kRow;
  for (const PlotSeries& series : plot.series) {
    const DrawingColour colour = colour_of(series);
    drawing.lines.push_back({{{x, y}, {x + kSample, y}}, colour, 1.8, kDashes[series.dash % kDashes.size()]});
    drawing.discs.push_back({{x + 0.5 * kSample, y}, 3.2, colour});
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
  for (const PlotSeries& series : plot.series) draw_series(drawing, series, frame);
  draw_legend(drawing, plot, frame);
  return drawing;
}

}  // namespace dmoscope::app
