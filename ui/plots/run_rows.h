#pragma once
// The table of runs as it is shown.

#include <optional>
#include <vector>

#include "core/view/run_table.h"
#include "core/view/view.h"
#include "ui/state/plot_state.h"

namespace dmoscope::ui {

/// A row a run, judged by the metric that is shown, in the order that the options ask for.
[[nodiscard]] std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options);

/// The input as a row beside them, by the metric that is shown; none while it has not been judged by that: see SessionView::input_summary.
[[nodiscard]] std::optional<RunRow> input_row(const SessionView& session);

/// The whole table, as it is saved and copied: the input, then the runs in their order.
[[nodiscard]] std::vector<RunRow> rows_to_save(const SessionView& session, const PlotOptions& options);

}  // namespace dmoscope::ui
