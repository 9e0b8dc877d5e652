#pragma once
// A plot in the window, drawn with ImGui's draw lists.

#include "ui/plots/plot_drawing.h"
#include "ui/plots/plot_interaction.h"
#include "ui/toolkit/items.h"

namespace dmoscope::ui {

/// The plot that the window drew last; made again when its keys change.
struct PlotCache {
  std::string plot_key, drawing_key;
  Plot plot;
  Drawing drawing;
  std::optional<PlotLayout> layout;
  PlotDrag drag;
};

/// Draws cache.plot into the remaining space, with its legend above and the values under the mouse. Returns the person's actions. Records
/// the items "plot", its inside, "plot-y", the value axis' labels, and "legend:NAME". `inside`: see PlotArea.
PlotOutcome draw_plot(PlotCache& cache, const PlotView& view, const Palette& palette, double scale, Items& items,
                      std::optional<Range> inside = {});

}  // namespace dmoscope::ui
