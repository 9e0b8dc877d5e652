#pragma once
// Where the values of a plot lie in a rectangle.

#include <optional>

#include "core/drawing/ticks.h"
#include "ui/plots/plot.h"

namespace dmoscope::ui {

/// From values to places and back. The places are those of a Drawing: y grows downwards.
struct Axis {
  double low = 0.0, high = 1.0;  // values at the ends
  double from = 0.0, to = 1.0;   // their places
  ValueAxis kind = ValueAxis::Linear;
  double pivot = 0.0;                              // of a linear one: even in the logarithm of 1 + value / this, unless 0
  [[nodiscard]] double shape(double value) const;  // in which the axis is even
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] double place_shaped(double shaped) const;  // of a value of that shape
  [[nodiscard]] double value(double place) const;
};

struct PlotLayout {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  // of the plot's inside
  Axis x, y;
  std::optional<Axis> strip;  // of the strip's values
};

/// The rectangle that a plot gets, with the ticks' labels; `font`: their height.
struct PlotArea {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double font = 12.0;
  std::optional<Range> inside{};  // from where to where across the plot's inside lies, so that something else is in line with it
};

/// Nothing when there is no value that could be shown.
[[nodiscard]] std::optional<PlotLayout> lay_out(const Plot& plot, const PlotView& view, const PlotArea& area);

/// A tick at a place of its axis, its label in the axis' unit.
struct PlacedTick {
  double place;
  std::string label;
};
[[nodiscard]] std::vector<PlacedTick> place_ticks(const Axis& axis, const AxisUnit& unit, bool integer, int most);

}  // namespace dmoscope::ui
