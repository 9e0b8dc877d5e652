#pragma once
// Plots as files: tables and pictures.

#include <string>
#include <vector>

#include "core/commands/commands.h"
#include "ui/plots/plot_builder.h"

namespace dmoscope::ui {

/// The visible numbers as comma separated values, a row for each number. Columns: run (empty where the plot has none), series, then the
/// quantity along the plot (iteration, seconds or percent) and value; for a histogram from, to and elements. Only x inside the visible
/// range; missing values (NaN) are empty. Numbers are the shortest that read back as the same double; times are in seconds whatever the
/// axes say.
[[nodiscard]] std::string plot_csv(const Plot& plot, const PlotView& view);

/// Serves requests of commands (state.requests.plots): files in the colours for paper, or the clipboard. Returns messages, errors included.
[[nodiscard]] std::vector<Message> serve_plot_requests(ViewState& state, const SessionView& session, const SortedQualities& sorted);

}  // namespace dmoscope::ui
