#pragma once
// A plot of several series over logarithmic or linear axes, one line per series, with a legend beside it.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// A value with the span of its measurements.
struct PlotValue {
  double x = 0.0, y = 0.0;
  double lowest = 0.0, highest = 0.0;  // span of y
};

struct PlotSeries {
  std::string name;        // empty: not in the legend
  std::size_t colour = 0;  // index into a palette of eight, modulo 8
  std::size_t dash = 0;    // modulo 4: 0 is solid, 1 dashed, 2 long dashes, 3 dotted
  bool muted = false;      // grey: the series that the others are compared with
  std::vector<PlotValue> values{};
  bool dots = true;    // dots on the values, with bars for the span of their measurements
  double width = 1.8;  // width of the line
};

/// An exact value, for series without dots.
[[nodiscard]] inline PlotValue exact(double x, double y) { return {x, y, y, y}; }

enum class AxisKind { Logarithmic, Linear };

/// Plot of several series. The first lies on top, so that it is not hidden by others along it; muted ones lie below all. Values that an
/// axis cannot have, not positive on a logarithmic one or not finite, leave a gap in the line.
struct LinePlot {
  std::string title, subtitle;
  std::string x_title, y_title;  // with units
  std::string note;              // one line below all
  std::vector<PlotSeries> series;
  AxisKind x_axis = AxisKind::Logarithmic, y_axis = AxisKind::Logarithmic;
  std::optional<double> y_lowest{};  // values below it are drawn at the lower edge, as the note should say
};

[[nodiscard]] Drawing draw(const LinePlot& plot);

/// Puts one drawing above the other.
[[nodiscard]] Drawing stacked(Drawing upper, const Drawing& lower);

}  // namespace dmoscope::app
