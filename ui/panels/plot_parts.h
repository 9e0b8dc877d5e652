#pragma once
// Parts of the bottom panel's plots.

#include "ui/panels/panels.h"
#include "ui/plots/plot.h"

namespace dmoscope::ui {

/// Draws the buttons that choose the plot.
void draw_plot_tabs(PanelContext& context);
/// Draws the shown plot's choices at the right end of the tabs' line; `rect`: of the panel.
void draw_plot_controls(PanelContext& context, const Rect& rect);
/// Draws the results of every run by the shown metric in the remaining space.
void draw_run_table(PanelContext& context);
/// Draws the first cell of a run's row in a table: its colour and title, recorded as `item`; a click makes it the active run.
void draw_run_cell(PanelContext& context, std::size_t run, const std::string& item, const std::string& title);
/// Draws all runs by every metric that one of them optimises in the remaining space.
void draw_comparison(PanelContext& context);
/// Draws the plot in the remaining space; a click in it shows that iteration. `inside`: see PlotArea.
void draw_plot_area(PanelContext& context, std::optional<Range> inside = {});

}  // namespace dmoscope::ui
