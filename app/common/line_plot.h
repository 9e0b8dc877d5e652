#pragma once
// A plot of several series over logarithmic or linear axes, one line per series, with a legend beside it.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// A value with how far its measurements lie apart.
struct PlotValue {
  double x = 0.0, y = 0.0;
  double lowest = 0.0, highest = 0.0;  // of y
};

struct PlotSeries {
  std::string name;        // empty: not in the legend
  std::size_t colour = 0;  // of a palette of eight, from the start again beyond
  std::size_t dash = 0;    // 0: solid, 1: dashed, 2: long dashes, 3: dotted; likewise
  bool muted = false;      // grey instead: what the others are compared with
  std::vector<PlotValue> values{};
  bool dots = true;    // on the values, with the bars of what their measurements span
  double width = 1.8;  // of the line
};

/// An exact value, for series without dots.
[[nodiscard]] inline PlotValue exact(double x, double y) { return {x, y, y, y}; }

enum class AxisKind { Logarithmic, Linear };

/// The first series lies on top, so that what a reader named first is not hidden where others run along it; muted ones lie below all.
/// A value that an axis cannot have, not positive on a logarithmic one or not finite, is not drawn: there the line has a gap.
struct LinePlot {
  std::string title, subtitle;
  std::string x_title, y_title;  // with units
  std::string note;              // one line below all
  std::vector<PlotSeries> series;
  AxisKind x_axis = AxisKind::Logarithmic, y_axis = AxisKind::Logarithmic;
  std::optional<double> y_lowest{};  // what lies below is drawn here, at the lower edge, and the note should say so
};

[[nodiscard]] Drawing draw(const LinePlot& plot);

/// One drawing above the other.
[[nodiscard]] Drawing stacked(Drawing upper, const Drawing& lower);

}  // namespace dmoscope::app
