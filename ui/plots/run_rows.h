#pragma once
// Rows of the table of runs.

#include <vector>

#include "core/view/run_table.h"
#include "core/view/view.h"
#include "ui/state/plot_state.h"

namespace dmoscope::ui {

/// A row for each run, judged by the shown metric, in the order that the options ask for.
[[nodiscard]] std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options);

/// A row for each mesh as it was read, by the shown metric; none for meshes that have not been judged by it, see InputView::summary.
[[nodiscard]] std::vector<RunRow> input_rows(const SessionView& session);

/// The whole table for saving and copying: the inputs, then the runs in their order.
[[nodiscard]] std::vector<RunRow> rows_to_save(const SessionView& session, const PlotOptions& options);

}  // namespace dmoscope::ui
