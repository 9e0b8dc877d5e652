#include "app/comparison/of_session.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/common/smooth_report.h"
#include "app/comparison/report.h"
#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"
#include "core/quality/metric_phrase.h"
#include "core/view/judgements.h"
#include "core/view/summaries.h"

namespace dmoscope::app {

namespace {

/// Records of the iterations whose values by the judge are known; the first is the input's.
std::vector<IterationRecord> judged_records(Run& run, Metric judge, ThreadPool* pool) {
  const std::vector<IterationRecord>& own = run.history().records();
  if (judge == run.parameters().metric) return own;
  std::vector<IterationRecord> records;
  const QualityContext context = run.input().quality_context();
  for (const std::uint64_t iteration : judged_iterations(own.size())) {
    const bool here = run.moment() == Moment{iteration};
    if (!here && !run.history().kept(iteration)) continue;
    const auto positions = here ? run.positions() : std::span<const Vec3>(run.history().nearest(iteration).positions);
    records.push_back(own[iteration]);
    records.back().statistics = compute_statistics(context, positions, judge, run.immovable(), pool);
  }
  return records;
}

JudgedRun judged_run(Run& run, std::string name, Metric judge, ThreadPool* pool) {
  const QualityContext context = run.input().quality_context();
  run.sync_to_host();
  JudgedRun judged;
  judged.name = std::move(name);
  judged.parameters = run.parameters();
  judged.backend_reason = run.backend_reason();
  judged.free = run.visits_per_iteration();
  judged.row = row_of(run, judge, pool);
  judged.row.title = judged.name;
  if (run.last_outcome())
    judged.outcome = *run.last_outcome();
  else
    judged.outcome.ended = run.moment().iteration;
  judged.card = report_card(run, pool);
  judged.records = judged_records(run, judge, pool);
  judged.after = compute_statistics(context, run.positions(), judge, run.immovable(), pool);
  judged.positions.assign(run.positions().begin(), run.positions().end());
  judged.qualities.resize(run.input().mesh.elements.size());
  element_qualities(context, judged.positions, judge, pool, judged.qualities);
  std::ranges::sort(judged.qualities);
  return judged;
}

/// The head of a report, about all runs together.
CompareOptions options_like(const Run& run) {
  CompareOptions options;
  const InputMesh& input = run.input();
  options.file = input.path.empty() ? std::filesystem::path(input.mesh.name) : input.path;
  for (const ParameterInfo& row : parameter_table()) options.run.parameters[std::string(row.name)] = row.to_text(run.parameters());
  if (run.parameters().combination) options.run.combine = phrase(run.parameters().metric, *run.parameters().combination);
  return options;
}

/// Makes the page about the runs on the active run's mesh, judged by the metric that is shown. Curves of runs by other metrics contain the
/// iterations known by it: the present one and those whose positions are kept.
std::string report_of_session(Session& session, Progress& progress) {
  const Run& active = session.active();
  ThreadPool* const pool = session.pool().get();
  Comparison comparison;
  comparison.input = session.input();
  comparison.judge = session.shown();
  require_defined(comparison.judge, *comparison.input);
  std::vector<double> before(comparison.input->mesh.elements.size());
  element_qualities(comparison.input->quality_context(), comparison.input->mesh.positions, comparison.judge, pool, before);
  comparison.input_curve = curve_of(before);
  comparison.input_percentiles = percentiles_of(before);
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < session.run_count(); ++k) {
    Run& run = session.run(k);
    std::string name = fmt::format("{} {}", k + 1, run.title());
    if (&run.input() != comparison.input.get()) {
      comparison.left_out.push_back({std::move(name), "it is on another mesh"});
      continue;
    }
    const Progress::Part part(progress, k, session.run_count());
    if (run.parameters().metric != comparison.judge)
      warnings.push_back(fmt::format("the course of {} has those iterations that are known by {}", name, info(comparison.judge).name));
    comparison.runs.push_back(judged_run(run, std::move(name), comparison.judge, pool));
    comparison.curves.push_back({comparison.runs.size() - 1, false, curve_of(comparison.runs.back().qualities)});
    std::vector<double>().swap(comparison.runs.back().qualities);
  }
  comparison.free = active.visits_per_iteration();
  const CompareOptions options = options_like(active);
  return html_of(comparison, {options, "runs as they stand in a session", pool->size(), {}, std::move(warnings)}, progress);
}

}  // namespace

void write_report_of_session(Session& session, const std::filesystem::path& file, Progress& progress) {
  const std::string page = report_of_session(session, progress);
  write_file_atomically(file, page);
}

}  // namespace dmoscope::app
