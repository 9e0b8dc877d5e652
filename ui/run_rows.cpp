#include "ui/run_rows.h"

namespace dmoscope::ui {

std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options) {
  std::vector<RunRow> rows;
  for (const RunView& run : session.runs) {
    rows.push_back(row_of(run, session.shown));
    rows.back().run = rows.size() - 1;
  }
  if (!options.sorted_by.empty()) sort_rows(rows, run_column(options.sorted_by), options.descending);
  return rows;
}

}  // namespace dmoscope::ui
