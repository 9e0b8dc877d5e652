#pragma once
// A plot: axes, several series, legend, hover, zoom. Drawn with ImGui's draw lists.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/theme.h"
#include "ui/ticks.h"
#include "ui/view_state.h"

namespace dmoscope::ui {

struct Series {
  enum class Kind { Line, Bars };
  std::string name;
  render::Rgb colour;
  std::vector<double> x, y;  // the same size, x ascending; a NaN in y is a gap. Bars stand from x to x + bar_width
  Kind kind = Kind::Line;
  double bar_width = 0.0;
  float width = 1.5F;  // of the line, pixels at scale 1
  float alpha = 1.0F;
  bool dashed = false;
};

struct PlotSpec {
  const char* id = "plot";
  std::string x_title, y_title;  // with units
  bool integer_x = false;
  std::optional<std::pair<double, double>> x_range, y_range;  // none: from the data
  std::optional<double> x_mark;                               // a vertical line, such as the moment shown
  std::string empty_text = "nothing to show yet";
  std::string hover_x;  // word before x in the readout, "iteration"
};

/// Draws into the space that is left and handles legend, hover, wheel zoom, drag and double click (all of it again).
/// Returns the x that was clicked, if any.
std::optional<double> draw_plot(const PlotSpec& spec, std::span<const Series> series, PlotView& view, const Palette& palette, double scale);

/// Smallest and largest finite y of the visible series over x in `x_range`, widened a little; only positive values when
/// `logarithmic`. Nothing when there is none.
[[nodiscard]] std::optional<std::pair<double, double>> value_range(std::span<const Series> series, const PlotView& view,
                                                                   std::pair<double, double> x_range);

}  // namespace dmoscope::ui
