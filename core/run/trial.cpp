#include "core/run/trial.h"

#include <algorithm>
#include <sstream>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/run/ending.h"
#include "core/run/run_task.h"

namespace dmoscope {

namespace {

/// Vertices of words like "4 7".
std::vector<Index> vertices_of(const std::string& words) {
  std::istringstream in(words);
  std::vector<Index> vertices;
  for (Index v = 0; in >> v;) vertices.push_back(v);
  return vertices;
}

/// Ends the iteration under way, not the trial.
struct OutOfTime {};

/// Run on a copy within a budget.
class Trial {
 public:
  Trial(const Run& like, RunParameters parameters, const BeginPositions& begin, const TrialBudget& budget, std::shared_ptr<ThreadPool> pool)
      : budget_(budget), run_(like.shared_input(), std::move(parameters), std::move(pool), 0, {}, begin) {
    const std::uint64_t weight = run_.input().is_volume() ? 10 : 1;
    most_ = budget.visits / std::max<std::uint64_t>(1, weight * run_.visits_per_iteration());
  }

  /// Goes on as the budget allows; false: not even one iteration was done.
  bool go(Progress& progress) {
    run_.set_observer([&](const Run&) { check(progress); });
    const bool waits = run_.parameters().then_joint.has_value();
    std::uint64_t in_phase = 0;
    try {
      while (in_phase < budget_.iterations) {
        if (iterations() >= most_) throw OutOfTime();
        check(progress);
        if (run_.step(StepUnit::Iteration, progress) == 0 && !next_phase_comes()) break;
        // Counts iterations of joint moves once they have begun: until then the minimum that the method reaches stands still.
        if (!waits || run_.joint_since()) ++in_phase;
      }
    } catch (const OutOfTime&) {
      cut_ = true;
    }
    return iterations() > 0;
  }
  /// Returns whether it has ended for want of time or visits.
  [[nodiscard]] bool is_cut() const noexcept { return cut_; }
  [[nodiscard]] std::uint64_t iterations() const { return run_.history().records().size() - 1; }
  [[nodiscard]] SwitchTrial result() const {
    const auto& records = run_.history().records();
    // Subtracts the fall of the minimum that the mean phase may make, which counts as none. Two aims give up what lies beyond the
    // threshold.
    double after = records[best_iteration(run_)].statistics.minimum - 2 * kLeastRise;
    const auto& two_aims = run_.parameters().combination;
    if (two_aims) after = std::min(after, two_aims->threshold);
    return {records.front().statistics.minimum, after, iterations()};
  }
  [[nodiscard]] bool untangles_less() const {
    const auto& records = run_.history().records();
    return records[best_iteration(run_)].statistics.inverted > records.front().statistics.inverted;
  }

 private:
  void check(Progress& progress) const {
    progress.check();
    if (budget_.go_on && !budget_.go_on()) throw Cancelled();
    if (budget_.time_left && !budget_.time_left()) throw OutOfTime();
  }
  [[nodiscard]] bool next_phase_comes() const { return run_.parameters().then_joint && !run_.phases().joint_over; }

  const TrialBudget& budget_;
  Run run_;
  std::uint64_t most_ = 0;
  bool cut_ = false;
};

}  // namespace

void apply_switch(const HoldSwitch& change, RunParameters& p) {
  if (change.name == "unfix") {
    std::erase_if(p.fixed, [named = vertices_of(change.value)](Index v) { return std::ranges::find(named, v) != named.end(); });
  } else if (change.name == "auto-corner") {
    say_corners(p.kinds, vertices_of(change.value), Saying::Automatic);
  } else if (change.name == "then") {
    set_then(p, change.value, {});
  } else if (change.name == "combine") {
    std::tie(p.metric, p.combination) = parse_composite(change.value, change.beside);
  } else {
    parameter_info(change.name).from_text(p, change.value);
  }
}

std::optional<SwitchTrial> try_switch(const Run& run, const HeldMinimum& held, const TrialBegin& begin, const TrialBudget& budget,
                                      std::shared_ptr<ThreadPool> pool, Progress& progress) {
  if (!held.change) return std::nullopt;
  RunParameters unchanged = run.parameters();
  unchanged.backend = Backend::Cpu;
  RunParameters parameters = unchanged;
  for (const auto& change : {held.change, held.also})
    if (change) apply_switch(*change, parameters);
  const BeginPositions& from = begin.positions ? begin.positions : run.begin();
  try {
    if (!why_no_run(run.shared_input(), parameters).empty()) return std::nullopt;
    Trial trial(run, parameters, from, budget, pool);
    if (!trial.go(progress) || trial.untangles_less()) return std::nullopt;
    SwitchTrial result = trial.result();
    result.from = begin.from;
    if (trial.is_cut() && !result.gains()) return std::nullopt;  // it may gain later: joint moves perhaps have not begun
    if (!held.rises() || !result.gains()) return result;
    TrialBudget as_long = budget;
    as_long.iterations = result.iterations;
    Trial alone(run, unchanged, from, as_long, std::move(pool));
    if (!alone.go(progress) || alone.is_cut()) return std::nullopt;
    result.alone = alone.result().after;
    return result;
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

}  // namespace dmoscope
