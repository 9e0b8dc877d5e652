#include "app/common/judged_run.h"

#include <algorithm>

#include "app/common/smooth_report.h"
#include "core/run/hints.h"
#include "core/run/retry_on_cpu.h"

namespace dmoscope::app {

namespace {

/// Counts all iterations of the run, also those after the one that it has gone back to.
void count_all(RunRow& row, const Run& run) {
  const auto& records = run.history().records();
  row.iterations = records.size() - 1;
  row.seconds = smoothing_seconds(run);
  const auto visits = static_cast<double>(row.iterations * run.visits_per_iteration());
  row.vertices_per_second = row.seconds > 0.0 ? visits / row.seconds : RunRow::kUnknown;
}

}  // namespace

JudgedRun run_judged(std::string name, std::shared_ptr<const InputMesh> input, RunParameters parameters, Metric judge, const Goal& goal,
                     const Workshop& workshop) {
  require_defined(judge, *input);
  ThreadPool* const pool = workshop.pool.get();
  const QualityContext context = input->quality_context();
  const bool own = judge == parameters.metric;
  Run run(input, std::move(parameters), workshop.pool, 0, workshop.acceleration);  // no past positions: none are asked for
  if (std::string warning = run.take_warning(); !warning.empty()) workshop.warn(std::move(warning));
  if (run.size_field() && !run.size_field()->note().empty()) workshop.warn(run.size_field()->note());

  std::vector<Statistics> judged;
  const auto judge_now = [&](const Run& now) {
    judged.push_back(compute_statistics(context, now.positions(), judge, now.immovable(), pool));
  };
  const auto smooth_all = [&] {
    run.reset(workshop.progress);  // after a failure the run is at the last positions that were asked for
    judged.clear();
    if (!own) judge_now(run);
    const Run::AfterIteration after = own ? Run::AfterIteration{} : judge_now;
    Outcome outcome = goal.until_converged ? run.until_converged(*goal.until_converged, workshop.progress, after)
                                           : run.iterate(goal.iterations, workshop.progress, after);
    if (goal.until_converged) {
      run.end_at_best(workshop.progress);
      outcome = *run.last_outcome();
    }
    run.sync_to_host();
    return outcome;
  };

  JudgedRun done;
  done.outcome = retry_on_cpu(run, smooth_all, workshop.warn);
  if (done.outcome.phases.joint_since && workshop.hints != Hints::Off) {
    const auto find_hold = [&] {
      const HintBudget budget = budget_of(workshop.hints, row_of(run, judge, pool).seconds);
      if (const auto held = what_holds(run, pool, workshop.progress, {.go_on = [&] { return budget.left(); }}))
        done.held = held->sentence(true);
    };
    look_afterwards("what holds the minimum", find_hold, workshop.warn);
  }
  if (done.held.ends_with('.')) done.held.pop_back();
  done.name = std::move(name);
  done.parameters = run.parameters();
  done.backend_reason = run.backend_reason();
  done.free = run.visits_per_iteration();
  done.card = report_card(run, pool);
  done.row = row_of(run, judge, pool);
  done.row.title = done.name;
  count_all(done.row, run);
  done.records = run.history().records();
  for (std::size_t i = 0; i < judged.size(); ++i) done.records[i].statistics = judged[i];
  done.after = done.records[run.moment().iteration].statistics;
  done.positions.assign(run.positions().begin(), run.positions().end());
  done.qualities.resize(input->mesh.elements.size());
  element_qualities(context, done.positions, judge, pool, done.qualities);
  std::ranges::sort(done.qualities);
  return done;
}

}  // namespace dmoscope::app
