#pragma once
// The table of runs as it is shown.

#include <vector>

#include "core/view/run_table.h"
#include "core/view/view.h"
#include "ui/state/plot_state.h"

namespace dmoscope::ui {

/// A row a run, judged by the metric that is shown, in the order that the options ask for.
[[nodiscard]] std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options);

/// The meshes as they were read, a row each beside the runs, by the metric that is shown; none of what has not been judged by that: see
/// InputView::summary.
[[nodiscard]] std::vector<RunRow> input_rows(const SessionView& session);

/// The whole table, as it is saved and copied: the inputs, then the runs in their order.
[[nodiscard]] std::vector<RunRow> rows_to_save(const SessionView& session, const PlotOptions& options);

}  // namespace dmoscope::ui
