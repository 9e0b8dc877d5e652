#pragma once
// Plots as files: tables and pictures.

#include <string>
#include <vector>

#include "core/commands/message.h"
#include "ui/plots/plot_series.h"

namespace dmoscope::ui {

/// The visible numbers as comma separated values, a row a number. Columns: run (empty where the plot has none), series, then what runs
/// along the plot (iteration, seconds or percent) and value; of a histogram from, to and elements. Only x inside the range that is shown;
/// what is not there (NaN) is empty. Numbers are the shortest that read back as the same double; times are in seconds whatever the axes
/// say.
[[nodiscard]] std::string plot_csv(const Plot& plot, const PlotView& view);

/// Writes a plot, all or nothing. Throws Error.
void save_plot(const PlotSave& save, const Plot& plot, const PlotView& view);

/// Does what commands asked for (state.requests.plots): files in the colours for paper, or the clipboard. Returns what there is to say,
/// errors included.
[[nodiscard]] std::vector<Message> serve_plot_requests(ViewState& state, const SessionView& session, const SortedQualities& sorted);

}  // namespace dmoscope::ui
