#include "ui/plots/run_rows.h"

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

std::optional<RunRow> input_row(const SessionView& session) {
  if (session.runs.empty()) return std::nullopt;
  if (const InputSummary* input = session.input_summary.get(); input != nullptr && input->metric == session.shown)
    return row_of_input(session.shown, input->statistics, input->percentiles);
  for (const RunView& run : session.runs) {
    if (run.parameters.metric != session.shown || run.records.empty() || run.records[0].iteration != 0) continue;
    return row_of_input(session.shown, run.records[0].statistics, run.percentiles.empty() ? Percentiles{} : run.percentiles[0]);
  }
  return std::nullopt;
}

std::vector<RunRow> rows_to_save(const SessionView& session, const PlotOptions& options) {
  std::vector<RunRow> rows = sorted_runs(session, options);
  if (std::optional<RunRow> input = input_row(session)) rows.insert(rows.begin(), std::move(*input));
  return rows;
}

}  // namespace dmoscope::ui
