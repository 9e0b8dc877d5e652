// Movement of a run along its path: steps, seeks, and runs of iterations.

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/stopwatch.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

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
    } else if (now.visits == 0 && fit_follows(now.iteration)) {
      fit(progress);
      begin_next_phase(progress);
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
  return fit_follows(iteration) || joint_follows(iteration) || joint_untangling_follows(iteration) || raise_of_worst_follows(iteration);
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

}  // namespace dmoscope
