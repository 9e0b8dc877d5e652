#pragma once
// Places of a plot's values in a rectangle.

#include <optional>

#include "core/drawing/ticks.h"
#include "ui/plots/plot.h"

namespace dmoscope::ui {

/// Maps values to places and back. The places are those of a Drawing: y grows downwards.
struct Axis {
  double low = 0.0, high = 1.0;  // values at the ends
  double from = 0.0, to = 1.0;   // places of the ends
  ValueAxis kind = ValueAxis::Linear;
  double pivot = 0.0;                              // for a linear axis: even in the logarithm of 1 + value / this, unless 0
  [[nodiscard]] double shape(double value) const;  // function of the value in which the axis is even
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] double place_shaped(double shaped) const;  // place of a value with that shape
  [[nodiscard]] double value(double place) const;
};

struct PlotLayout {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  // borders of the plot's inside
  Axis x, y;
  std::optional<Axis> strip;  // axis of the strip's values
};

/// The rectangle that a plot gets, with the ticks' labels; `font`: their height.
struct PlotArea {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double font = 12.0;
  double beside = 0.8;            // room to the right of the plot's inside, in heights of the font
  std::optional<Range> inside{};  // given interval of the plot's inside across, so that it is in line with something else
};

/// Layout of a plot in an area; none if there is no value to show.
[[nodiscard]] std::optional<PlotLayout> lay_out(const Plot& plot, const PlotView& view, const PlotArea& area);

/// A tick at a place of its axis, with its label in the axis' unit.
struct PlacedTick {
  double place;
  std::string label;
};
[[nodiscard]] std::vector<PlacedTick> place_ticks(const Axis& axis, const AxisUnit& unit, bool integer, int most);

}  // namespace dmoscope::ui
