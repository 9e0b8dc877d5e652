#pragma once
// The table of runs as it is shown.

#include <optional>
#include <vector>

#include "core/session/run_table.h"
#include "core/session/view.h"
#include "ui/plot_state.h"

namespace dmoscope::ui {

/// A row a run, judged by the metric that is shown, in the order that the options ask for.
[[nodiscard]] std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options);

/// The input as a row beside them, by the metric that is shown; none where no run optimises that, so that nobody has judged it.
[[nodiscard]] std::optional<RunRow> input_row(const SessionView& session);

}  // namespace dmoscope::ui
