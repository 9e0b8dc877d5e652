#include "ui/analysis/comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/csv_text.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

const JudgedBy* find_metric(const std::vector<JudgedBy>* by, Metric metric) {
  if (by == nullptr) return nullptr;
  const auto at = std::ranges::find(*by, metric, &JudgedBy::metric);
  return at == by->end() ? nullptr : &*at;
}

void add_metric(Comparison::Row& row, const JudgedBy* by) {
  const JudgedBy unknown{Metric::MeanRatio, NAN, NAN, NAN, {}};
  for (const double value :
       {(by == nullptr ? unknown : *by).minimum, (by == nullptr ? unknown : *by).p1, (by == nullptr ? unknown : *by).mean})
    row.cells.push_back({value, false});
}

/// Marks the largest values of a column if there are two that look different.
void mark_best(Comparison& comparison, std::size_t column) {
  double best = -INFINITY, least = INFINITY;
  for (const Comparison::Row& row : comparison.rows) {
    const double value = row.cells[column].value;
    if (row.run == Comparison::kInput || !std::isfinite(value)) continue;
    best = std::max(best, value);
    least = std::min(least, value);
  }
  if (!(best > least) || short_number(best) == short_number(least)) return;
  for (Comparison::Row& row : comparison.rows)
    row.cells[column].best = row.run != Comparison::kInput && short_number(row.cells[column].value) == short_number(best);
}

/// Whether the runs that optimise a metric are those with the best minimum by it, for all metrics that several runs optimise.
bool each_wins_its_own(const Comparison& comparison, const SessionView& session) {
  std::size_t won = 0;
  for (std::size_t m = 0; m < comparison.metrics.size(); ++m)
    for (const Comparison::Row& row : comparison.rows) {
      const Comparison::Cell& cell = row.cells[m * Comparison::kMeasures];
      if (!cell.best) continue;
      if (session.runs[row.run].parameters.metric != comparison.metrics[m]) return false;
      ++won;
    }
  return won > 1;
}

}  // namespace

std::string comparison_csv(const Comparison& comparison, const SessionView& session) {
  std::string text = "run";
  for (const Metric metric : comparison.metrics)
    for (const char* measure : {"min", "p1", "mean"}) text += "," + csv_text(fmt::format("{} {}", measure, info(metric).name));
  text += '\n';
  for (const Comparison::Row& row : comparison.rows) {
    text += row.run == Comparison::kInput ? std::string("input") : csv_text(session.runs[row.run].title);
    for (const Comparison::Cell& cell : row.cells) text += std::isfinite(cell.value) ? fmt::format(",{}", cell.value) : std::string(",");
    text += '\n';
  }
  return text;
}

const JudgedBy* judged_by(const RunView& run, Metric metric) { return find_metric(run.judged.get(), metric); }

Comparison compare_runs(const SessionView& session) {
  Comparison comparison;
  if (session.runs.size() < 2) return comparison;
  const auto add = [&](Metric metric) {
    if (std::ranges::find(comparison.metrics, metric) == comparison.metrics.end()) comparison.metrics.push_back(metric);
  };
  for (const RunView& run : session.runs) add(run.parameters.metric);
  add(session.shown);  // last, because the shown metric changes by a click, and nothing must move then
  const auto mesh = std::ranges::find(session.meshes, session.input, &InputView::input);
  if (mesh != session.meshes.end()) {
    comparison.rows.emplace_back();
    for (const Metric metric : comparison.metrics) add_metric(comparison.rows.back(), find_metric(mesh->judged.get(), metric));
  }
  for (std::size_t k = 0; k < session.runs.size(); ++k) {
    comparison.rows.push_back({k, {}});
    for (const Metric metric : comparison.metrics) add_metric(comparison.rows.back(), judged_by(session.runs[k], metric));
  }
  for (std::size_t column = 0; column < comparison.metrics.size() * Comparison::kMeasures; ++column) mark_best(comparison, column);
  if (each_wins_its_own(comparison, session)) comparison.remark = "Each metric wins by its own measure.";
  return comparison;
}

}  // namespace dmoscope::ui
