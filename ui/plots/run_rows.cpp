#include "ui/plots/run_rows.h"

#include <iterator>
#include <optional>

#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

std::optional<RunRow> input_row(const SessionView& session, const InputView& mesh) {
  if (const InputSummary* input = mesh.summary.get(); input != nullptr && input->metric == session.shown)
    return row_of_input(session.shown, input->statistics, input->percentiles);
  for (const RunView& run : session.runs) {
    if (run.input != mesh.input || run.parameters.metric != session.shown) continue;
    if (run.records.empty() || run.records[0].iteration != 0) continue;
    return row_of_input(session.shown, run.records[0].statistics, run.percentiles.empty() ? Percentiles{} : run.percentiles[0]);
  }
  return std::nullopt;
}

}  // namespace

std::vector<RunRow> sorted_runs(const SessionView& session, const PlotOptions& options) {
  std::vector<RunRow> rows;
  for (const RunView& run : session.runs) {
    rows.push_back(row_of(run, session.shown));
    rows.back().run = rows.size() - 1;
    if (session.several_meshes()) rows.back().mesh = run.input->mesh.name;
  }
  if (!options.sorted_by.empty()) sort_rows(rows, run_column(options.sorted_by), options.descending);
  for (RunRow& row : rows) row.title = run_title(session, row.run);
  return rows;
}

std::vector<RunRow> input_rows(const SessionView& session) {
  std::vector<RunRow> rows;
  for (const InputView& mesh : session.meshes) {
    std::optional<RunRow> row = input_row(session, mesh);
    if (!row) continue;
    if (session.several_meshes()) row->mesh = mesh.input->mesh.name;
    rows.push_back(std::move(*row));
  }
  return rows;
}

std::vector<RunRow> rows_to_save(const SessionView& session, const PlotOptions& options) {
  std::vector<RunRow> rows = sorted_runs(session, options);
  std::vector<RunRow> inputs = input_rows(session);
  rows.insert(rows.begin(), std::make_move_iterator(inputs.begin()), std::make_move_iterator(inputs.end()));
  return rows;
}

}  // namespace dmoscope::ui
