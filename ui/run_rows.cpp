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

std::optional<RunRow> input_row(const SessionView& session) {
  for (const RunView& run : session.runs) {
    if (run.parameters.metric != session.shown || run.records.empty() || run.records[0].iteration != 0) continue;
    const Statistics& input = run.records[0].statistics;
    RunRow row;
    row.title = "input";
    row.minimum = input.minimum;
    row.movable_minimum = input.movable_minimum;
    row.mean = input.mean;
    row.inverted = static_cast<double>(input.inverted);
    row.seconds = RunRow::kUnknown;
    if (!run.percentiles.empty()) row.p1 = run.percentiles[0].p1, row.p5 = run.percentiles[0].p5;
    return row;
  }
  return std::nullopt;
}

}  // namespace dmoscope::ui
