#pragma once
// A plot of several series over logarithmic axes, one line a series, with a legend beside it.

#include <cstddef>
#include <string>
#include <vector>

#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// A value with how far its measurements lie apart. Only positive x and y are drawn.
struct PlotValue {
  double x = 0.0, y = 0.0;
  double lowest = 0.0, highest = 0.0;  // of y
};

struct PlotSeries {
  std::string name;
  std::size_t colour = 0;  // of a palette of eight, from the start again beyond
  std::size_t dash = 0;    // 0: solid, 1: dashed, 2: long dashes, 3: dotted; likewise
  bool muted = false;      // grey instead: what the others are compared with
  std::vector<PlotValue> values;
};

struct LinePlot {
  std::string title, subtitle;
  std::string x_title, y_title;  // with units
  std::string note;              // one line below all
  std::vector<PlotSeries> series;
};

[[nodiscard]] Drawing draw(const LinePlot& plot);

}  // namespace dmoscope::app
