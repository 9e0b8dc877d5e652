// Runs of iterations: until convergence or a limit.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/run/ending.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::string Outcome::sentence() const {
  std::string rose =
      last_rise == 0 ? "the minimum rose in none of these iterations" : fmt::format("the minimum last rose in iteration {}", last_rise);
  if (inverted > 0) rose += fmt::format("; {} element{} still inverted", inverted, inverted == 1 ? " is" : "s are");
  for (const JointUntangling& each : untanglings)
    rose += fmt::format("; in iteration {}, {} vertices moved together, which untangled {} of {} inverted element{}", each.iteration,
                        each.moved, each.before - each.after, each.before, each.before == 1 ? "" : "s");
  const auto begin = [](const std::optional<std::uint64_t>& from) {
    return from ? fmt::format(", which begins with the state of {}, the best one before", iteration_name(*from)) : std::string();
  };
  if (phases.joint_since)
    rose += fmt::format("; vertices moved jointly from iteration {} on{}", *phases.joint_since + 1, begin(phases.joint_from));
  if (raised > 0)
    rose += fmt::format("; in {} iteration{} vertices around the worst element moved together", raised, raised == 1 ? "" : "s");
  if (phases.mean_since)
    rose += fmt::format("; the mean was raised from iteration {} on{}", *phases.mean_since + 1, begin(phases.mean_from));
  if (best) rose += fmt::format("; back at {}, the best one", iteration_name(*best));
  switch (reason) {
    case StopReason::NothingMoved:
      return fmt::format("converged: no vertex moved any more; {}", rose);
    case StopReason::NoRise:
      return fmt::format("converged: neither the minimum nor {} rose by {} in {} iterations; {}",
                         phases.mean_since ? "the mean" : "the movable minimum", limits.rise, limits.patience, rose);
    case StopReason::Certified:
      return fmt::format("converged: {}; {}",
                         two_aims ? "what joint moves reach of the second aim is certified, with the first as it is"
                                  : "the minimum is certified, no joint move raises it",
                         rose);
    case StopReason::NoJointGain:
      return fmt::format("converged: joint moves raise {} no further; {}", two_aims ? "the two aims" : "the minimum", rose);
    case StopReason::IterationLimit:
      break;
  }
  return fmt::format("stopped at the iteration limit; {}", rose);
}

namespace {

ConvergenceLimits iterations_alone(std::uint64_t iterations) {
  return {.patience = iterations, .max_iterations = iterations, .rise = ConvergenceLimits{}.rise};
}

}  // namespace

/// Course of a run until convergence or a limit. `from`: the iteration that counts as the begin; later ones that were done before are gone
/// through by their records.
class Run::Advance {
 public:
  Advance(Run& run, const ConvergenceLimits& limits, bool stop_when_still, std::uint64_t from, Progress& progress,
          const AfterIteration& after);
  Advance(const Advance&) = delete;
  Advance& operator=(const Advance&) = delete;
  ~Advance() {
    run_.pursuit_.reset();
    run_.raises_ = run_.looked_ = false;
    run_.next_raise_.reset();
  }
  Outcome outcome();

 private:
  void next_iteration(bool anew);
  void take_best(const IterationRecord& record, bool anew);
  void note_rise(const IterationRecord& record);
  void note_phase(const IterationRecord& record);
  void note_joint(const IterationRecord& record);
  void judge_end(const IterationRecord& record, bool whole);
  void end_certified();
  [[nodiscard]] bool raises_worst_now(bool idle, bool& certified);
  void look_for_certificate(const IterationRecord& record, bool idle);

  [[nodiscard]] bool is_idle(const Statistics& now) const {
    constexpr std::uint64_t kIdle = 20;  // iterations
    return std::min(since_rise_, reached_ - best_alone_.iteration()) == kIdle && now.inverted == 0;
  }
  /// Number of further iterations without a rise that end the run.
  [[nodiscard]] std::uint64_t patience_left() const { return limits_.patience - std::min(since_rise_, limits_.patience); }
  [[nodiscard]] static Phase last_phase_of(const RunParameters& parameters) {
    if (parameters.then_mean) return Phase::Mean;
    return parameters.then_joint || method_info(parameters.method).joint ? Phase::Joint : Phase::Method;
  }
  [[nodiscard]] static RunParameters without_mean(RunParameters parameters) {
    parameters.then_mean.reset();
    return parameters;
  }

  Run& run_;
  const ConvergenceLimits limits_;
  const bool stop_when_still_;
  Progress& progress_;
  const AfterIteration& after_;
  Outcome outcome_;
  const Phase last_phase_;
  Phase phase_ = Phase::Method;  // phase of the iteration last reached
  std::uint64_t reached_;
  double minimum_ = 0.0, movable_ = 0.0, mean_ = 0.0;  // greatest so far; the mean when it last changed
  std::uint64_t since_rise_ = 0, quiet_ = 0;           // quiet: iterations in a row in which nothing moved
  bool stopped_ = false, looks_ = false;
  BestState best_, best_alone_;          // alone: the method's phase is the same whatever comes after it
  std::vector<Vec3> positions_of_best_;  // kept where the history has no room for them, so that they need not be computed again
  bool has_best_ = false;
};

Run::Advance::Advance(Run& run, const ConvergenceLimits& limits, bool stop_when_still, std::uint64_t from, Progress& progress,
                      const AfterIteration& after)
    : run_(run),
      limits_(limits),
      stop_when_still_(stop_when_still),
      progress_(progress),
      after_(after),
      outcome_{.limits = limits, .two_aims = run.parameters_.combination.has_value()},
      last_phase_(last_phase_of(run.parameters_)),
      reached_(from),
      best_(run.parameters_),
      best_alone_(without_mean(run.parameters_)) {
  run.recover();
  RunParameters& parameters = run.parameters_;
  // A second phase must not begin while the first may still gain. Where none has begun, the iterations so far are those of any patience.
  if (std::optional<PhaseBegin>& next = parameters.then_joint ? parameters.then_joint : parameters.then_mean;
      stop_when_still && next && !run.first_phase_end())
    next->patience = std::max(next->patience, limits.patience);
  // Allows for a place in the midst of an iteration, of which the history has no record.
  reached_ = std::min(from, run.at_.moment.iteration);  // after a failure the run may stand before it
  const auto& records = run.history_.records();
  const Statistics start =
      reached_ < run.at_.moment.iteration ? records[reached_].statistics : run.recovering([&run] { return run.statistics(); });
  outcome_.inverted = start.inverted;
  minimum_ = start.minimum;
  movable_ = start.movable_minimum;
  mean_ = start.mean;
  for (const IterationRecord& record : std::span(records).first(reached_ + 1)) {
    best_.take(record);
    best_alone_.take(record);
  }
  looks_ = stop_when_still && run.can_be_certified();
  // Single vertices leave a tangle as they find it; what they are stuck in then is raised. A phase of joint moves does better, for all.
  run.raises_ = stop_when_still && !parameters.then_joint && records.front().statistics.inverted > 0 && run.can_raise_worst();
  run.pursuit_ = Pursuit{reached_, reached_ + limits.max_iterations, stop_when_still};
}

Outcome Run::Advance::outcome() {
  while (!stopped_ && outcome_.iterations < limits_.max_iterations) {
    const bool whole = run_.at_.moment.visits == 0, anew = reached_ == run_.at_.moment.iteration;
    next_iteration(anew);
    const IterationRecord record = run_.history_.records()[reached_];
    take_best(record, anew);
    note_rise(record);
    note_phase(record);
    if (after_ && anew) run_.recovering([this] { after_(run_); });
    note_joint(record);
    judge_end(record, whole);
  }
  if (has_best_ && best_.iteration() != reached_) run_.history_.hold(best_.iteration(), positions_of_best_, run_.pool_.get());
  outcome_.ended = reached_;
  run_.last_outcome_ = outcome_;
  return outcome_;
}

/// Makes the next iteration, or goes through it by its record.
void Run::Advance::next_iteration(bool anew) {
  const bool counts = last_phase_ == outcome_.phases.of(reached_ + 1) && last_phase_ != Phase::Joint;
  if (stop_when_still_ && counts) run_.pursuit_->patience_left = patience_left();
  if (anew) {
    const Progress::Part part(progress_, outcome_.iterations, limits_.max_iterations);
    run_.step(StepUnit::Iteration, progress_);
  }
  ++reached_;
  ++outcome_.iterations;
  ++since_rise_;
}

void Run::Advance::take_best(const IterationRecord& record, bool anew) {
  best_.take(record);
  best_alone_.take(record);
  if (anew && stop_when_still_ && best_.iteration() == reached_) has_best_ = run_.copy_unkept(positions_of_best_);
}

void Run::Advance::note_rise(const IterationRecord& record) {
  const Statistics& now = record.statistics;
  outcome_.inverted = now.inverted;
  if (run_.fit_follows(reached_ - 1)) {  // the state that rises are counted from is the fitted one, which may be worse than the input
    minimum_ = now.minimum;
    movable_ = now.movable_minimum;
  }
  // Compares differences: where nothing is movable both are infinite, and that is no rise.
  if (!(now.minimum - minimum_ >= limits_.rise || now.movable_minimum - movable_ >= limits_.rise)) return;
  since_rise_ = 0;
  outcome_.last_rise = reached_;
  minimum_ = std::max(minimum_, now.minimum);
  movable_ = std::max(movable_, now.movable_minimum);
}

void Run::Advance::note_phase(const IterationRecord& record) {
  const Phase phase = RunPhases{.joint_since = run_.joint_since(), .mean_since = run_.mean_since()}.of(reached_);
  const bool begins = phase != std::exchange(phase_, phase);
  if (begins) {
    outcome_.phases = run_.phases();
    // Ignores what records behind those gone through may tell of a later phase.
    if (phase == Phase::Joint) outcome_.phases.joint_over = outcome_.phases.mean_since = outcome_.phases.mean_from = std::nullopt;
  }
  if (begins || (phase == Phase::Mean && std::abs(record.statistics.mean - mean_) >= limits_.rise)) {
    since_rise_ = 0;
    mean_ = record.statistics.mean;
  }
}

void Run::Advance::note_joint(const IterationRecord& record) {
  const Index left = record.statistics.inverted;
  const auto end = phase_ == Phase::Joint && record.joint ? record.joint->end : JointState::End::None;
  if (end != JointState::End::None) {
    outcome_.phases.joint_over = reached_;
    if (stop_when_still_ && last_phase_ == Phase::Joint) {
      stopped_ = true;
      outcome_.reason = end == JointState::End::Certified && left == 0 ? StopReason::Certified : StopReason::NoJointGain;
    }
  }
  if (phase_ == Phase::Method && record.joint) ++outcome_.raised;
  const Index before = run_.history_.records()[reached_ - 1].statistics.inverted;
  if (run_.is_joint(reached_ - 1) && !run_.raise_of_worst_follows(reached_ - 1) && before > left)
    outcome_.untanglings.push_back({reached_, record.moved, before, left});
}

/// Finds out whether the run is over: nothing moves, nothing rises, or a look at the worst element certifies it.
void Run::Advance::judge_end(const IterationRecord& record, bool whole) {
  if (since_rise_ == 0) run_.looked_ = false;
  if (record.raise_follows) {  // the look has been made then
    run_.looked_ = true;
    return;
  }
  const Statistics& now = record.statistics;
  const bool idle = is_idle(now);
  bool certified = false;
  if (raises_worst_now(idle, certified)) return;
  // A phase's end is not the run's; joint moves know themselves when they are over.
  if (phase_ == Phase::Joint || phase_ != last_phase_) return;
  // Counts still iterations of DMO in the last phase, which searches as DMO does, whatever the method.
  const RunParameters& parameters = run_.parameters_;
  auto needed = phase_ == Phase::Mean ? 1 : still_iterations(method_info(parameters.method), parameters.options, run_.input_->is_volume());
  if (needed && run_.attempts_to_untangle(reached_)) *needed += UntanglingPlan::kCycle;
  quiet_ = whole && record.moved == 0 ? quiet_ + 1 : 0;
  const bool still = needed && quiet_ >= *needed;
  stopped_ = stop_when_still_ && (still || since_rise_ >= limits_.patience);
  if (stopped_) outcome_.reason = still ? StopReason::NothingMoved : StopReason::NoRise;
  if (certified) end_certified();
  if (looks_ && now.inverted == 0 && !run_.looked_) look_for_certificate(record, idle);
}

void Run::Advance::end_certified() {
  stopped_ = true;
  outcome_.reason = StopReason::Certified;
}

/// In a run of a tangled mesh: looks at the worst element once the method is idle, and returns whether a joint move of it follows.
bool Run::Advance::raises_worst_now(bool idle, bool& certified) {
  if (!idle || !run_.raises_ || phase_ != Phase::Method) return false;
  run_.looked_ = true;
  if (reached_ != run_.at_.moment.iteration) return false;
  RaiseOfWorst look = run_.look_at_worst(progress_);
  certified = look.certified && looks_;
  return run_.raise_follows_look(std::move(look));
}

/// Looks once after each rise. Where few vertices move, the iterations that are left cost less than the look.
void Run::Advance::look_for_certificate(const IterationRecord& record, bool idle) {
  constexpr std::uint64_t kWorthALook = 400'000;  // visits, of which those of volumes are ten times as dear
  const bool pays = record.moved * patience_left() >= (run_.input_->is_volume() ? kWorthALook / 10 : kWorthALook);
  if (!(stopped_ ? run_.raises_ : idle && pays)) return;
  run_.looked_ = true;
  if (reached_ != run_.at_.moment.iteration) return;
  RaiseOfWorst look = run_.look_at_worst(progress_);
  if (look.certified)
    end_certified();
  else if (run_.raises_ && run_.raise_follows_look(std::move(look)))
    stopped_ = false;
}

Outcome Run::iterate(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return Advance(*this, iterations_alone(iterations), false, at_.moment.iteration, progress, after).outcome();
}

Outcome Run::iterate_from_input(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return Advance(*this, iterations_alone(iterations), false, 0, progress, after).outcome();
}

Outcome Run::until_converged_from_input(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return Advance(*this, limits, true, 0, progress, after).outcome();
}

Outcome Run::until_converged(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return Advance(*this, limits, true, at_.moment.iteration, progress, after).outcome();
}

void Run::end_at_best(Progress& progress) {
  if (!last_outcome_) return;
  Outcome outcome = *last_outcome_;
  const std::uint64_t best = best_iteration(parameters_, std::span(history_.records()).first(outcome.ended + 1));
  if (best == outcome.ended) return;
  seek({best}, progress);
  outcome.best = best;
  outcome.inverted = history_.records()[best].statistics.inverted;
  last_outcome_ = outcome;
}

/// Copies the positions at the end of an iteration, where the host has them and the history does not; else returns false, and none.
bool Run::copy_unkept(std::vector<Vec3>& copy) const {
  copy.clear();
  if (history_.kept(at_.moment.iteration) || !positions_.host_is_at(at_.moment)) return false;
  copy.assign(positions_.host().begin(), positions_.host().end());
  return true;
}

}  // namespace dmoscope
