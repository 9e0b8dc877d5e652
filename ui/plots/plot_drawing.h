#pragma once
// A plot as a drawing: the inside for the window, or the whole as a picture for a file.

#include "core/drawing/drawing.h"
#include "ui/plots/plot_layout.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {

struct PlotInk {
  render::Rgb background, text, dim, grid, accent;
};
[[nodiscard]] PlotInk ink_of(const Palette& palette);

/// Draws grid, ticks, series, brush and marks, at the places of `layout`. `font`: height of the ticks' labels; `unit`: of all other
/// lengths, such as the lines' widths. `beside`: room for names of curves at their ends, to the right.
void draw_plot_area(Drawing& drawing, const Plot& plot, const PlotView& view, const PlotLayout& layout, const PlotInk& ink, double font,
                    double unit, double beside = 0.0);

/// Draws a sample of a series for a legend, from x to the right and around y, with lengths in `unit`.
void draw_sample(Drawing& drawing, const Series& look, double x, double y, const PlotInk& ink, double unit);

/// The plot in its visible range, with title, legend of visible series, and axes' titles, for white paper. Lengths in units; text is 12
/// high.
[[nodiscard]] Drawing whole_plot(const Plot& plot, const PlotView& view, double width, double height, const PlotInk& ink);

}  // namespace dmoscope::ui
