// Movement of a run along its path: steps, seeks, and runs of iterations.

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/stopwatch.h"
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
    rose += fmt::format("; in iteration {} {} vertices moved together, which untangled {} of {} inverted element{}", each.iteration,
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

void Run::visit(std::uint64_t count, Progress& progress) {
  const auto whole = static_cast<double>(visits_per_iteration());
  while (count > 0) {
    progress.check();
    const std::uint64_t block = std::min({count, visits_per_iteration() - at_.moment.visits, blocks_.visits()});
    recovering([&] { visit_block(block); });
    begin_next_phase(progress);
    count -= block;
    const double done = at_.moment.visits == 0 ? 1.0 : static_cast<double>(at_.moment.visits) / whole;
    progress.set(done);
    if (observer_) recovering([this] { observer_(*this); });
  }
}

/// Goes to the state that the next phase begins from, at the end of the first phase. After it the run stands there for good, whichever way
/// it has come: the records alone tell which state that is.
void Run::begin_next_phase(Progress& progress) {
  if (!at_.moment.is_iteration_end() || first_phase_end() != at_.moment.iteration) return;
  const auto best = first_phase_best();
  if (!best) return;
  const std::uint64_t turn = at_.moment.iteration;
  std::vector<Vec3> positions;
  if (const auto* found = first_phase_.find(*best)) {
    positions = *found;
  } else {
    const History::Kept kept = history_.nearest(*best);
    if (kept.iteration == *best) {
      positions.assign(kept.positions.begin(), kept.positions.end());
    } else {  // the run was read, or its history had no room
      const std::uint64_t moved = last_moved_;
      restore(*best);
      walk_to({*best}, progress);
      last_moved_ = moved;
      positions.assign(this->positions().begin(), this->positions().end());
    }
  }
  put(positions, {{turn}});
  history_.hold(turn, positions, pool_.get());
  first_phase_.clear();
}

void Run::visit_block(std::uint64_t count) {
  const auto searched = executor_.smoother->searched();
  const Stopwatch watch;
  at_.moved += asking_device([&] { return ask_smoother(at_.moment.visits, count); });
  const double seconds = watch.seconds();
  at_.seconds += seconds;
  if (searched) at_.searched += executor_.smoother->searched().value_or(*searched) - *searched;
  blocks_.learn(count, seconds);
  at_.moment.visits += count;
  at_.moment.edits = 0;
  if (at_.moment.visits == visits_per_iteration()) end_iteration();
}

void Run::end_iteration() {
  RunProgress done = std::exchange(at_, {{at_.moment.iteration + 1}});
  if (!executor_.smoother->positions_on_device()) {  // storing positions of the host is part of the smoothing
    download();
    done.seconds += positions_.download_seconds();
  }
  record(done);
  last_moved_ = done.moved;
}

void Run::walk_to(const Moment& target, Progress& progress) {
  const std::uint64_t whole = visits_per_iteration();
  last_outcome_.reset();
  keep();
  ensure_smoother();
  while (at_.moment < target) {
    const Moment& now = at_.moment;
    progress.check();
    if (const Edit* edit = edits_.at(now)) {
      recovering([&] { do_edit(edit->vertices); });
    } else if (now.visits == 0 && joint_untangling_follows(now.iteration)) {
      untangle_jointly(progress);
      begin_next_phase(progress);
    } else if (now.visits == 0 && joint_follows(now.iteration)) {
      move_jointly(progress);
    } else if (now.visits == 0 && raise_of_worst_follows(now.iteration)) {
      raise_worst_jointly(progress);
      begin_next_phase(progress);
    } else if (whole == 0) {                                                     // nothing is free: an iteration visits no vertex
      recovering([this] { input_->share ? visit_block(0) : end_iteration(); });  // other processes visit the vertices of their shares
      begin_next_phase(progress);
    } else {
      std::uint64_t stop = now.iteration < target.iteration ? whole : target.visits;
      if (const Edit* next = edits_.after(now); next != nullptr && next->at.iteration == now.iteration)
        stop = std::min(stop, next->at.visits);
      visit(stop - now.visits, progress);
    }
  }
}

std::uint64_t Run::step(StepUnit unit, Progress& progress) {
  recover();
  const RunProgress before = at_;
  Moment target{at_.moment.iteration + 1};
  if (visits_per_iteration() > 0 && unit == StepUnit::Vertex) {
    if (edits_.at(at_.moment) != nullptr) {
      target = at_.moment;
      ++target.edits;
    } else {
      target = {at_.moment.iteration, at_.moment.visits + 1};
    }
  } else if (visits_per_iteration() > 0 && unit == StepUnit::Class) {
    target = {at_.moment.iteration, *std::ranges::upper_bound(colouring_->class_offsets, at_.moment.visits)};
  }
  walk_to(target, progress);
  return (at_.moment.iteration > before.moment.iteration ? last_moved_ : at_.moved) - before.moved;
}

/// Returns whether the next iteration is a joint move, which is one step.
bool Run::is_joint(std::uint64_t iteration) const {
  return joint_follows(iteration) || joint_untangling_follows(iteration) || raise_of_worst_follows(iteration);
}

Moment Run::moment_before(StepUnit unit) const {
  const std::uint64_t whole = visits_per_iteration();
  Moment target = at_.moment;
  // The end of an iteration is the same place as the start of the next; from there "back" goes into the iteration before.
  if (target.is_iteration_end()) {
    target = {target.iteration - 1, whole};
    if (unit != StepUnit::Iteration && is_joint(target.iteration)) return {target.iteration, 0, edits_.count_at({target.iteration})};
  }
  if (unit == StepUnit::Iteration || whole == 0) return {target.iteration};
  if (unit == StepUnit::Vertex) {
    if (target.edits > 0) return {target.iteration, target.visits, target.edits - 1};
    --target.visits;
    return {target.iteration, target.visits, edits_.count_at(target)};
  }
  const auto& starts = colouring_->class_offsets;
  const auto here = target.edits > 0 ? std::ranges::upper_bound(starts, target.visits) : std::ranges::lower_bound(starts, target.visits);
  return {target.iteration, *std::prev(here)};
}

bool Run::back(StepUnit unit, Progress& progress) {
  recover();
  if (at_.moment == Moment{}) return false;
  seek(moment_before(unit), progress);
  return true;
}

void Run::seek(const Moment& wanted, Progress& progress) {
  const std::uint64_t whole = visits_per_iteration();
  if (wanted.visits > whole) throw UsageError(fmt::format("an iteration has {} visits, not {}", whole, wanted.visits));
  const bool at_end = wanted.visits == whole && wanted.visits > 0;  // is the start of the next iteration
  const Moment target = at_end ? Moment{wanted.iteration + 1, 0, wanted.edits} : wanted;
  if (const std::uint64_t edits = edits_.count_at(target); target.edits > edits)
    throw UsageError(fmt::format("there {} {} visit{} of chosen vertices at that moment, not {}", edits == 1 ? "was" : "were", edits,
                                 edits == 1 ? "" : "s", target.edits));
  last_outcome_.reset();
  recover();
  keep();
  if (target == at_.moment) return;
  if (target < at_.moment || history_.nearest(target.iteration).iteration > at_.moment.iteration) restore(target.iteration);
  walk_to(target, progress);
}

void Run::go_to(const RunSnapshot& point, Progress& progress) {
  recover();
  keep();
  const std::vector<Edit>&mine = edits_.all(), &theirs = point.edits.whole();
  const auto [a, b] = std::mismatch(mine.begin(), mine.end(), theirs.begin(), theirs.end());
  if (a != mine.end() || b != theirs.end()) {
    const Moment parting = a == mine.end() ? b->at : b == theirs.end() ? a->at : std::min(a->at, b->at);
    forget_after(parting.iteration);
    if (parting < at_.moment) restore(parting.iteration);
    edits_.replace(point.edits);
    ++path_;
  }
  history_.restore_records(point.records);
  joint_course_.restore(point.joint);
  seek(point.moment, progress);
  last_outcome_ = point.outcome;
}

/// Goes to the last kept positions that are no later than the end of `iteration`.
void Run::restore(std::uint64_t iteration) {
  const History::Kept& kept = history_.nearest(iteration);
  put(kept.positions, {{kept.iteration}});
}

/// Stands at a place whose positions are given.
void Run::put(std::span<const Vec3> positions, const RunProgress& place) {
  positions_.assign(positions, place);
  if (executor_.smoother) executor_.smoother->positions_replaced();
  at_ = place;
}

/// Returns whether an iteration after this one may untangle elements that it did not.
bool Run::attempts_to_untangle(std::uint64_t iteration) const {
  const auto& records = history_.records();
  return records[iteration].statistics.inverted > 0 && method_info(parameters_.method).optimises &&
         iterations_since_untangled(records, iteration) < UntanglingPlan::kEnd;
}

Outcome Run::iterate(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return advance({.patience = iterations, .max_iterations = iterations, .rise = ConvergenceLimits{}.rise}, false, at_.moment.iteration,
                 progress, after);
}

Outcome Run::iterate_from_input(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return advance({.patience = iterations, .max_iterations = iterations, .rise = ConvergenceLimits{}.rise}, false, 0, progress, after);
}

Outcome Run::until_converged_from_input(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return advance(limits, true, 0, progress, after);
}

Outcome Run::until_converged(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return advance(limits, true, at_.moment.iteration, progress, after);
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

/// Goes on until convergence or a limit. `from`: the iteration that counts as the begin; later ones that were done before are gone through
/// by their records.
Outcome Run::advance(const ConvergenceLimits& limits, bool stop_when_still, std::uint64_t from, Progress& progress,
                     const AfterIteration& after) {
  Outcome outcome{.limits = limits, .two_aims = parameters_.combination.has_value()};
  recover();
  // A second phase must not begin while the first may still gain. Where none has begun, the iterations so far are those of any patience.
  if (std::optional<PhaseBegin>& next = parameters_.then_joint ? parameters_.then_joint : parameters_.then_mean;
      stop_when_still && next && !first_phase_end())
    next->patience = std::max(next->patience, limits.patience);
  // Allows for a place in the midst of an iteration, of which the history has no record.
  from = std::min(from, at_.moment.iteration);  // after a failure the run may stand before it
  const Statistics start = from < at_.moment.iteration ? history_.records()[from].statistics : recovering([this] { return statistics(); });
  outcome.inverted = start.inverted;
  std::uint64_t reached = from;
  double minimum = start.minimum, movable = start.movable_minimum, mean = start.mean;
  std::uint64_t since_rise = 0, quiet = 0;  // quiet: iterations in a row in which nothing moved
  bool stopped = false;
  const bool joint_comes = parameters_.then_joint || method_info(parameters_.method).joint;
  const Phase last_phase = parameters_.then_mean ? Phase::Mean : joint_comes ? Phase::Joint : Phase::Method;
  RunParameters alone = parameters_;  // the method's phase is the same whatever comes after it
  alone.then_mean.reset();
  BestState best(parameters_), best_alone(alone);
  for (const IterationRecord& record : std::span(history_.records()).first(from + 1)) {
    best.take(record);
    best_alone.take(record);
  }
  std::vector<Vec3> positions_of_best;  // kept where the history has no room for them, so that they need not be computed again
  bool has_best = false;
  const auto phase_of = [this](std::uint64_t iteration) {
    return RunPhases{.joint_since = joint_since(), .mean_since = mean_since()}.of(iteration);
  };
  // Ignores what records behind those gone through may tell of a later phase.
  const auto phases_reached = [this](Phase phase) {
    RunPhases reached_so_far = phases();
    if (phase == Phase::Joint) reached_so_far.joint_over = reached_so_far.mean_since = reached_so_far.mean_from = std::nullopt;
    return reached_so_far;
  };
  Phase phase_before = Phase::Method;
  constexpr std::uint64_t kIdle = 20, kWorthALook = 400'000;  // iterations; visits, of which those of volumes are ten times as dear
  const bool looks = stop_when_still && can_be_certified();
  // Single vertices leave a tangle as they find it; what they are stuck in then is raised. A phase of joint moves does better, for all.
  raises_ = stop_when_still && !parameters_.then_joint && history_.records().front().statistics.inverted > 0 && can_raise_worst();
  pursuit_ = Pursuit{from, from + limits.max_iterations, stop_when_still};
  const std::unique_ptr<Run, void (*)(Run*)> at_the_end(this, [](Run* run) {
    run->pursuit_.reset();
    run->raises_ = run->looked_ = false;
    run->next_raise_.reset();
  });
  while (!stopped && outcome.iterations < limits.max_iterations) {
    const bool whole = at_.moment.visits == 0;
    const bool anew = reached == at_.moment.iteration;
    const bool counts = last_phase == outcome.phases.of(reached + 1) && last_phase != Phase::Joint;
    if (stop_when_still && (counts || (outcome.inverted > 0 && !joint_comes)))
      pursuit_->patience_left = limits.patience - std::min(since_rise, limits.patience);
    if (anew) {
      const Progress::Part part(progress, outcome.iterations, limits.max_iterations);
      step(StepUnit::Iteration, progress);
    }
    ++reached;
    ++outcome.iterations;
    ++since_rise;
    const IterationRecord record = history_.records()[reached];
    const Statistics& now = record.statistics;
    best.take(record);
    best_alone.take(record);
    if (anew && stop_when_still && best.iteration() == reached) has_best = copy_unkept(positions_of_best);
    // Compares differences: where nothing is movable both are infinite, and that is no rise.
    if (now.minimum - minimum >= limits.rise || now.movable_minimum - movable >= limits.rise) {
      since_rise = 0;
      outcome.last_rise = reached;
      minimum = std::max(minimum, now.minimum);
      movable = std::max(movable, now.movable_minimum);
    }
    const Phase phase = phase_of(reached);
    const bool begins = phase != std::exchange(phase_before, phase);
    if (begins) outcome.phases = phases_reached(phase);
    if (begins || (phase == Phase::Mean && std::abs(now.mean - mean) >= limits.rise)) {
      since_rise = 0;
      mean = now.mean;
    }
    if (after && anew) recovering([&] { after(*this); });
    outcome.inverted = now.inverted;
    const auto joint_end = phase == Phase::Joint && record.joint ? record.joint->end : JointState::End::None;
    if (joint_end != JointState::End::None) outcome.phases.joint_over = reached;
    if (stop_when_still && joint_end != JointState::End::None && (last_phase == Phase::Joint || now.inverted > 0)) {
      stopped = true;
      outcome.reason = joint_end == JointState::End::Certified && now.inverted == 0 ? StopReason::Certified : StopReason::NoJointGain;
    }
    if (phase == Phase::Method && record.joint) ++outcome.raised;
    if (const Index inverted = history_.records()[reached - 1].statistics.inverted;
        is_joint(reached - 1) && !raise_of_worst_follows(reached - 1) && inverted > now.inverted)
      outcome.untanglings.push_back({reached, record.moved, inverted, now.inverted});
    if (since_rise == 0) looked_ = false;
    if (record.raise_follows) {  // the look has been made then
      looked_ = true;
      continue;
    }
    const bool idle = std::min(since_rise, reached - best_alone.iteration()) == kIdle && now.inverted == 0;
    bool certified = false;
    if (idle && raises_ && phase == Phase::Method) {
      looked_ = true;
      if (reached == at_.moment.iteration) {
        RaiseOfWorst look = look_at_worst(progress);
        certified = look.certified && looks;
        if (raise_follows_look(std::move(look))) continue;
      }
    }
    // A phase's end is not the run's; joint moves know themselves when they are over.
    if (phase == Phase::Joint || (phase != last_phase && (now.inverted == 0 || joint_comes))) continue;
    // Counts still iterations of DMO in the last phase, which searches as DMO does, whatever the method.
    auto needed = phase == Phase::Mean ? 1 : still_iterations(method_info(parameters_.method), parameters_.options, input_->is_volume());
    if (needed && attempts_to_untangle(reached)) *needed += UntanglingPlan::kCycle;
    quiet = whole && record.moved == 0 ? quiet + 1 : 0;
    const bool still = needed && quiet >= *needed;
    stopped = stop_when_still && (still || since_rise >= limits.patience);
    if (stopped) outcome.reason = still ? StopReason::NothingMoved : StopReason::NoRise;
    // Looks once after each rise. Where few vertices move, the iterations that are left cost less than the look.
    if (certified) {
      stopped = true;
      outcome.reason = StopReason::Certified;
    }
    if (!looks || now.inverted > 0 || looked_) continue;
    const std::uint64_t visits_left = record.moved * (limits.patience - std::min(since_rise, limits.patience));
    const bool pays = visits_left >= (input_->is_volume() ? kWorthALook / 10 : kWorthALook);
    if (!(stopped ? raises_ : idle && pays)) continue;
    looked_ = true;
    if (reached != at_.moment.iteration) continue;
    RaiseOfWorst look = look_at_worst(progress);
    if (look.certified) {
      stopped = true;
      outcome.reason = StopReason::Certified;
    } else if (raises_ && raise_follows_look(std::move(look))) {
      stopped = false;
    }
  }
  if (has_best && best.iteration() != reached) history_.hold(best.iteration(), positions_of_best, pool_.get());
  outcome.ended = reached;
  last_outcome_ = outcome;
  return outcome;
}

}  // namespace dmoscope
