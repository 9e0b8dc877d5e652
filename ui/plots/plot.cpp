#include "ui/plots/plot.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {
namespace {

/// The end of the legend that the isolated name belongs to, if there is such a name.
std::optional<bool> isolated_kind(const Plot& plot, const PlotView& view) {
  if (view.isolated.empty()) return std::nullopt;
  for (const LegendEntry& entry : plot.legend) {
    if (entry.name == view.isolated) return entry.of_run;
  }
  return std::nullopt;
}

bool name_on(const Plot& plot, const PlotView& view, const std::string& name, bool of_run) {
  if (name.empty()) return true;
  if (const auto kind = isolated_kind(plot, view); kind && *kind == of_run) return name == view.isolated;
  return !view.hidden.contains(name);
}

double shaped(ValueAxis axis, double value) {
  if (axis == ValueAxis::Log) return std::log10(value);
  return axis == ValueAxis::LogDistance ? -std::log10(1.0 - value) : value;
}

double unshaped(ValueAxis axis, double value) {
  if (axis == ValueAxis::Log) return std::pow(10.0, value);
  return axis == ValueAxis::LogDistance ? 1.0 - std::pow(10.0, -value) : value;
}

std::optional<std::size_t> nearest_sample(const Series& one, double at) {
  if (one.x.empty()) return std::nullopt;
  if (one.kind != Series::Kind::Line) {
    const auto after = std::upper_bound(one.x.begin(), one.x.end(), at);
    if (after == one.x.begin()) return std::nullopt;
    const auto k = static_cast<std::size_t>(after - one.x.begin()) - 1;
    return at <= one.x[k] + one.bar_width ? std::optional(k) : std::nullopt;
  }
  const auto after = std::lower_bound(one.x.begin(), one.x.end(), at);
  if (after == one.x.end()) return one.x.size() - 1;
  const auto k = static_cast<std::size_t>(after - one.x.begin());
  return k > 0 && at - one.x[k - 1] < one.x[k] - at ? k - 1 : k;
}

}  // namespace

bool is_on(const Plot& plot, const PlotView& view, const LegendEntry& entry) { return name_on(plot, view, entry.name, entry.of_run); }

bool is_visible(const Plot& plot, const PlotView& view, const Series& series) {
  return name_on(plot, view, series.run, true) && name_on(plot, view, series.name, false);
}

std::string full_name(const Plot& plot, const Series& series) {
  if (series.run.empty() && series.name.empty()) return plot.y_title;
  if (series.run.empty() || series.name.empty()) return series.run + series.name;
  return series.run + " " + series.name;
}

Range x_extent(const Plot& plot) {
  if (plot.x_range) return *plot.x_range;
  double low = INFINITY, high = -INFINITY;
  for (const Series& s : plot.series) {
    if (s.x.empty()) continue;
    low = std::min(low, s.x.front());
    high = std::max(high, s.x.back() + s.bar_width);
  }
  if (!(high >= low)) return {0.0, 1.0};
  if (high == low) high = low + (plot.integer_x || low == 0.0 ? 1.0 : std::abs(low));
  return {low, high};
}

Range x_seen(const Plot& plot, const PlotView& view) { return view.x_range ? *view.x_range : plot.x_home ? *plot.x_home : x_extent(plot); }

bool can_show(ValueAxis axis, double value) {
  if (!std::isfinite(value)) return false;
  return axis == ValueAxis::Linear || (axis == ValueAxis::Log ? value > 0.0 : value < 1.0);
}

std::optional<Range> value_range(const Plot& plot, const PlotView& view, Range x_range, bool strip) {
  const ValueAxis axis = strip ? ValueAxis::Linear : plot.axis;
  double low = INFINITY, high = -INFINITY;
  bool bars = strip || plot.from_zero;
  for (const Series& one : plot.series) {
    if (one.strip != strip || !is_visible(plot, view, one)) continue;
    bars = bars || one.kind != Series::Kind::Line;
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (one.x[k] + one.bar_width < x_range.first || one.x[k] > x_range.second || !can_show(axis, one.y[k])) continue;
      low = std::min(low, one.y[k]);
      high = std::max(high, one.y[k]);
    }
  }
  if (!(high >= low)) return std::nullopt;
  if (axis == ValueAxis::Linear && bars) return Range{0.0, high > 0.0 ? 1.06 * high : 1.0};
  if (axis == ValueAxis::Log && plot.tab == PlotTab::Histogram) return Range{0.7, 1.5 * high};
  const double from = shaped(axis, low), to = shaped(axis, high);
  const double least = axis == ValueAxis::Linear ? std::max(1e-3, 0.05 * std::abs(high)) : 0.1;
  const double margin = to > from ? 0.06 * (to - from) : least;
  return Range{unshaped(axis, from - margin), unshaped(axis, to + margin)};
}

std::vector<Reading> read_plot(const Plot& plot, const PlotView& view, double at) {
  const Range all = x_extent(plot);
  const double near = plot.integer_x ? 0.5 : 0.01 * (all.second - all.first);
  std::vector<Reading> readings;
  for (const Series& one : plot.series) {
    if (!is_visible(plot, view, one)) continue;
    const auto k = nearest_sample(one, at);
    if (!k) continue;
    const bool beyond = at > one.x.back() + one.bar_width + near || at < one.x.front() - near;
    if (!beyond) readings.push_back({&one, *k});
  }
  return readings;
}

AxisUnit time_unit(double largest) {
  if (!(largest < 1.0)) return {1.0, "s"};
  return largest < 1e-3 ? AxisUnit{1e6, "µs"} : AxisUnit{1e3, "ms"};
}

}  // namespace dmoscope::ui
