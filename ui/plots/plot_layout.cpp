#include "ui/plots/plot_layout.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {
namespace {

constexpr double kLeast = 1e-300;  // least argument of logarithms

/// A range that is valid on an axis of this kind.
Range usable(ValueAxis kind, Range range) {
  if (kind == ValueAxis::Log) range.first = std::max(range.first, range.second > 0.0 ? 1e-12 * range.second : kLeast);
  if (kind == ValueAxis::LogDistance) range.second = std::min(range.second, 1.0 - 1e-15);
  return range;
}

}  // namespace

double Axis::shape(double value) const {
  if (pivot > 0.0) return std::log10(std::max(1.0 + value / pivot, kLeast));
  if (kind == ValueAxis::Log) return std::log10(std::max(value, kLeast));
  return kind == ValueAxis::LogDistance ? -std::log10(std::max(1.0 - value, kLeast)) : value;
}

double Axis::place(double value) const { return place_shaped(shape(value)); }

double Axis::place_shaped(double shaped) const { return from + (shaped - shape(low)) / (shape(high) - shape(low)) * (to - from); }

double Axis::value(double place) const {
  const double shaped = shape(low) + (place - from) / (to - from) * (shape(high) - shape(low));
  if (pivot > 0.0) return pivot * (std::pow(10.0, shaped) - 1.0);
  if (kind == ValueAxis::Log) return std::pow(10.0, shaped);
  return kind == ValueAxis::LogDistance ? 1.0 - std::pow(10.0, -shaped) : shaped;
}

std::optional<PlotLayout> lay_out(const Plot& plot, const PlotView& view, const PlotArea& area) {
  const Range x = x_seen(plot, view);
  const auto values = view.y_range ? view.y_range : value_range(plot, view, x);
  const auto strip = plot.strip_share > 0.0 ? value_range(plot, view, x, true) : std::nullopt;
  if (!values && !strip) return std::nullopt;
  PlotLayout layout;
  const Range inside = area.inside.value_or(Range{area.left + 4.2 * area.font, area.left + area.width - area.beside * area.font});
  layout.left = inside.first;
  layout.right = std::max(layout.left + 1.0, inside.second);
  layout.top = area.top + 0.4 * area.font;
  layout.bottom = std::max(layout.top + 2.0, area.top + area.height - 1.45 * area.font);
  layout.x = {x.first, x.second, layout.left, layout.right, ValueAxis::Linear, plot.x_pivot};
  double bottom = layout.bottom;
  if (strip) {
    const double gap = 1.2 * area.font, height = std::max(1.0, layout.bottom - layout.top - gap);
    const double top = layout.bottom - (values ? plot.strip_share : 1.0) * height;
    layout.strip = Axis{strip->first, strip->second, layout.bottom, top, ValueAxis::Linear};
    bottom = std::max(layout.top + 1.0, top - gap);
  }
  const Range y = usable(plot.axis, values.value_or(Range{0.0, 1.0}));
  layout.y = {y.first, y.second, bottom, layout.top, plot.axis};
  return layout;
}

std::vector<PlacedTick> place_ticks(const Axis& axis, const AxisUnit& unit, bool integer, int most) {
  std::vector<PlacedTick> placed;
  const auto put = [&](const std::vector<Tick>& ticks, auto value_of) {
    for (const Tick& tick : ticks) placed.push_back({axis.place(value_of(tick.value)), tick.label});
  };
  const double f = unit.factor;
  switch (axis.kind) {
    case ValueAxis::Linear: {
      const double low = axis.low * f, high = axis.high * f;
      std::vector<Tick> ticks;
      if (axis.pivot > 0.0) ticks = log_ticks_from_zero(low, high, axis.pivot * f, most);
      for (int n = most; n < most + 4 && ticks.size() < 2; ++n) ticks = integer ? integer_ticks(low, high, n) : linear_ticks(low, high, n);
      put(ticks, [f](double v) { return v / f; });
      break;
    }
    case ValueAxis::Log:
      put(log_ticks(axis.low * f, axis.high * f, most), [f](double v) { return v / f; });
      break;
    case ValueAxis::LogDistance:
      put(log_ticks(1.0 - axis.high, 1.0 - axis.low, most), [](double v) { return 1.0 - v; });
      break;
  }
  return placed;
}

}  // namespace dmoscope::ui
