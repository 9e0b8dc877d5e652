#pragma once
// The table of runs as it is shown.

#include <vector>

#include "core/session/run_table.h"
#include "core/session/view.h"
#include "ui/plot_state.h"

namespace dmoscope::ui {

/// A row a run, judged by the metric that is shown, in the order that the options ask for.
[[nodiscard]] std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options);

}  // namespace dmoscope::ui
