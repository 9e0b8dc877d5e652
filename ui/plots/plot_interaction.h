#pragma once
// Actions of the mouse in a plot, as commands. No ImGui: tests play it.

#include <optional>
#include <string>
#include <vector>

#include "ui/plots/plot_layout.h"

namespace dmoscope::ui {

/// State of the mouse over a plot in one frame.
struct PlotMouse {
  double x = 0.0, y = 0.0;                                      // places of the layout
  bool over = false;                                            // over the inside, or an axis' labels
  bool left_pressed = false, left_down = false, twice = false;  // twice: pressed for the second time
  bool right_pressed = false, right_down = false;
  bool shift = false;
  double wheel = 0.0;
};

/// State of a drag while a button is held.
struct PlotDrag {
  enum class Kind { None, Pan, Box, Brush };
  Kind kind = Kind::None;
  double x0 = 0.0, y0 = 0.0;  // place where it was pressed
  double x = 0.0, y = 0.0;    // present place
  bool moved = false;         // far enough not to be a click
  bool right = false;         // whether the drag is with the right button
};

struct PlotOutcome {
  std::vector<std::string> commands;
  std::optional<double> clicked;  // x of a click without a drag
  bool menu = false;              // a right click without a drag
};

/// Handles the mouse. Wheel: zooms x, over the value axis' labels y. Left drag: brushes the histogram, else moves a zoomed plot. Right
/// drag, or left with Shift: zooms to a box, or to a stretch of x when it is flat. Double click: back to the first range. A click on the
/// histogram clears the brush, a right click asks for the menu.
[[nodiscard]] PlotOutcome handle_mouse(const PlotMouse& mouse, PlotDrag& drag, const Plot& plot, const PlotView& view,
                                       const PlotLayout& layout, double scale);

/// Range of x that a brush from one place to another selects: whole bins, at least one.
[[nodiscard]] Range brushed(const Plot& plot, const PlotLayout& layout, double from, double to);

}  // namespace dmoscope::ui
