#pragma once
// What the bottom panel's plots are made of.

#include "ui/panels/panels.h"
#include "ui/plots/plot.h"

namespace dmoscope::ui {

/// Buttons that choose the plot.
void draw_plot_tabs(PanelContext& context);
/// The shown plot's choices, at the right end of the tabs' line; `rect`: of the panel.
void draw_plot_controls(PanelContext& context, const Rect& rect);
/// How every run fares, by the metric that is shown, in the space that is left.
void draw_run_table(PanelContext& context);
/// First cell of a run's row in a table: its colour and title, recorded as `item`; a click makes it the active run.
void draw_run_cell(PanelContext& context, std::size_t run, const std::string& item, const std::string& title);
/// All runs by every metric that one of them optimises, in the space that is left.
void draw_comparison(PanelContext& context);
/// The plot in the space that is left; a click in it shows that iteration. `inside`: see PlotArea.
void draw_plot_area(PanelContext& context, std::optional<Range> inside = {});

}  // namespace dmoscope::ui
