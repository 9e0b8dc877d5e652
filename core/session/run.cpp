#include "core/session/run.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/base/memory.h"

namespace dmoscope {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<std::uint8_t> fixed_vertices(const InputMesh& input, std::span<const Index> chosen) {
  const auto boundary = input.topology.boundary();
  std::vector<std::uint8_t> fixed(boundary.begin(), boundary.end());
  for (Index v = 0; v < fixed.size(); ++v)
    if (input.topology.star(v).empty()) fixed[v] = 1;
  for (const Index v : chosen) {
    if (v >= fixed.size()) throw UsageError(fmt::format("fixed vertex {} does not exist: the mesh has {} vertices", v, fixed.size()));
    fixed[v] = 1;
  }
  return fixed;
}

std::vector<Index> free_vertices(std::span<const std::uint8_t> fixed, const VisitOrder& order) {
  std::vector<Index> free;
  for (Index v = 0; v < fixed.size(); ++v)
    if (fixed[v] == 0) free.push_back(v);
  return order.seed ? shuffled(free, *order.seed) : free;
}

std::shared_ptr<const Colouring> make_colouring(const InputMesh& input, std::span<const Index> free, ThreadPool* pool) {
  Colouring colouring = colour_vertices(input.mesh, input.topology, free);
  arrange_classes(colouring, input.mesh, input.geometry.plane, input.topology, pool);
  return std::make_shared<const Colouring>(std::move(colouring));
}

std::vector<Vec3> working_copy(std::span<const Vec3> positions) {
  std::vector<Vec3> copy;
  reserve_large(copy, positions.size());
  copy.assign(positions.begin(), positions.end());
  return copy;
}

}  // namespace

std::string Outcome::sentence() const {
  const std::string rose = last_rise == 0 ? "the minimum never rose" : fmt::format("the minimum last rose in iteration {}", last_rise);
  switch (reason) {
    case StopReason::NothingMoved:
      return fmt::format("converged: no vertex moved any more; {}", rose);
    case StopReason::NoRise:
      return fmt::format("converged: neither the minimum nor the movable minimum rose by {} in {} iterations; {}", limits.rise,
                         limits.patience, rose);
    case StopReason::IterationLimit:
      break;
  }
  return fmt::format("stopped at the iteration limit; {}", rose);
}

Run::Run(std::shared_ptr<const InputMesh> input, RunParameters parameters, std::shared_ptr<ThreadPool> pool, std::size_t history_bytes,
         Acceleration acceleration)
    : input_(std::move(input)),
      parameters_(std::move(parameters)),
      pool_(std::move(pool)),
      fixed_(fixed_vertices(*input_, parameters_.fixed)),
      colouring_(make_colouring(*input_, free_vertices(fixed_, parameters_.order), pool_.get())),
      immovable_(immovable_elements(input_->mesh, fixed_, pool_.get())),
      executor_(make_executor(parameters_.backend, acceleration, task())),
      positions_(working_copy(input_->mesh.positions)),
      blocks_(executor_.smoother->positions_are_far()),
      history_(history_bytes) {
  history_.record_input({0, statistics(), 0, 0.0}, {input_, &input_->mesh.positions});
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

std::string Run::title() const { return fmt::format("{} · {}", parameters_.method, info(parameters_.metric).name); }

std::string Run::backend_sentence() const {
  if (executor_.backend != name(Backend::Cpu)) return fmt::format("{}: {}", executor_.backend, executor_.reason);
  const unsigned threads = pool_->size();
  const std::string cpu = fmt::format("{}, {} thread{}", executor_.backend, threads, threads == 1 ? "" : "s");
  return executor_.reason.empty() ? cpu : fmt::format("{} ({})", cpu, executor_.reason);
}

SmoothingTask Run::task() const {
  return {parameters_.method, input_, colouring_, parameters_.metric, parameters_.search, immovable_, pool_.get()};
}

/// Does what may ask a device; a failure is remembered for recover().
template <class Body>
auto Run::asking_device(const Body& body) const {
  try {
    return body();
  } catch (const DeviceError& error) {
    failure_ = error.what();
    throw;
  }
}

/// Does what may ask a device; after a failure the run has recovered, and the error says so.
template <class Body>
auto Run::recovering(const Body& body) {
  try {
    return body();
  } catch (const DeviceError&) {
    recover();
    throw DeviceError(take_warning());
  }
}

void Run::bring() const {
  if (brought_ && brought_->moment == at_.moment) return;
  const auto start = Clock::now();
  brought_.reset();
  asking_device([this] { executor_.smoother->store(positions_, pool_.get()); });
  brought_ = at_;
  bring_seconds_ = seconds_since(start);
}

std::span<const Vec3> Run::positions() const {
  bring();
  return positions_;
}

Statistics Run::statistics() const {
  const auto& [iteration, visits] = at_.moment;
  if (visits == 0 && iteration < history_.records().size()) return history_.records()[iteration].statistics;
  if (const auto found = asking_device([this] { return executor_.smoother->statistics(); })) return *found;
  return compute_statistics(input_->quality_context(), positions(), parameters_.metric, immovable_, pool_.get());
}

std::shared_ptr<const DevicePicture> Run::picture(Metric shown) const { return executor_.smoother->picture(shown); }

void Run::settle() {
  recover();
  recovering([this] { bring(); });
  keep();
}

void Run::recover() {
  if (failure_.empty()) return;
  executor_ = executor_after_failure(fmt::format("{} failed: {}", executor_.backend, failure_), task());
  failure_.clear();
  blocks_ = BlockPlan(executor_.smoother->positions_are_far());
  const History::Kept& kept = history_.nearest(at_.moment.iteration);
  const Moment of_history{kept.iteration, 0};
  if (!brought_ || brought_->moment < of_history) {
    positions_.assign(kept.positions.begin(), kept.positions.end());
    brought_ = Place{of_history};
  }
  at_ = *brought_;
  history_.forget_after(at_.moment.iteration);
  const auto& [iteration, visits] = at_.moment;
  executor_.warning = fmt::format("{}; the run is back at iteration {}{}, and the CPU can go on from there", executor_.reason, iteration,
                                  visits == 0 ? "" : fmt::format(" and {} visits", visits));
}

void Run::record(const Place& done) {
  const std::uint64_t iteration = at_.moment.iteration;
  if (iteration < history_.records().size()) return;  // been here before
  history_.record({iteration, statistics(), done.moved, done.seconds});
  unkept_seconds_ += done.seconds;
  const bool dear = executor_.smoother->positions_are_far() && !worth_bringing(bring_seconds_, unkept_seconds_);
  if (!history_.wants(iteration) || dear) return;
  bring();
  keep();
}

/// Keeps the positions of an iteration's end, where they have been brought anyway.
void Run::keep() {
  if (at_.moment.visits != 0 || !brought_ || brought_->moment != at_.moment) return;
  history_.keep(at_.moment.iteration, positions_, pool_.get());
  unkept_seconds_ = 0.0;
}

void Run::visit(std::uint64_t count, Progress& progress) {
  const auto whole = static_cast<double>(visits_per_iteration());
  last_outcome_.reset();
  keep();
  while (count > 0) {
    progress.check();
    const std::uint64_t block = std::min({count, visits_per_iteration() - at_.moment.visits, blocks_.visits()});
    recovering([&] { visit_block(block); });
    count -= block;
    const double done = at_.moment.visits == 0 ? 1.0 : static_cast<double>(at_.moment.visits) / whole;
    progress.set(progress_base_ + progress_span_ * done);
    if (observer_) recovering([this] { observer_(*this); });
  }
}

void Run::visit_block(std::uint64_t count) {
  const auto start = Clock::now();
  at_.moved += asking_device([&] { return executor_.smoother->visit(at_.moment.visits, count, positions_, pool_.get()); });
  const double seconds = seconds_since(start);
  at_.seconds += seconds;
  blocks_.learn(count, seconds);
  at_.moment.visits += count;
  if (at_.moment.visits == visits_per_iteration()) end_iteration();
}

void Run::end_iteration() {
  Place done = std::exchange(at_, {{at_.moment.iteration + 1, 0}});
  if (!executor_.smoother->positions_are_far()) {  // where they are near, storing them is part of the smoothing
    bring();
    done.seconds += bring_seconds_;
  }
  record(done);
  last_moved_ = done.moved;
}

std::uint64_t Run::step(StepUnit unit, Progress& progress) {
  recover();
  if (visits_per_iteration() == 0) {  // nothing is free: an iteration visits nobody
    recovering([this] { end_iteration(); });
    return 0;
  }
  const std::uint64_t before = at_.moved;
  std::uint64_t target = visits_per_iteration();
  if (unit == StepUnit::Vertex) target = at_.moment.visits + 1;
  if (unit == StepUnit::Class) target = *std::ranges::upper_bound(colouring_->class_offsets, at_.moment.visits);
  visit(target - at_.moment.visits, progress);
  return (at_.moment.visits == 0 ? last_moved_ : at_.moved) - before;
}

bool Run::back(StepUnit unit, Progress& progress) {
  recover();
  if (at_.moment == Moment{}) return false;
  const std::uint64_t whole = visits_per_iteration();
  // The end of an iteration is the same place as the start of the next; from there "back" goes into the iteration before.
  Moment target = at_.moment.visits > 0 ? at_.moment : Moment{at_.moment.iteration - 1, whole};
  if (unit == StepUnit::Iteration || whole == 0) {
    target.visits = 0;
  } else if (unit == StepUnit::Vertex) {
    --target.visits;
  } else {
    target.visits = *std::prev(std::ranges::lower_bound(colouring_->class_offsets, target.visits));
  }
  seek(target, progress);
  return true;
}

void Run::seek(Moment target, Progress& progress) {
  last_outcome_.reset();
  recover();
  keep();
  const History::Kept& kept = history_.nearest(target.iteration);
  if (target < at_.moment || kept.iteration > at_.moment.iteration) {
    positions_.assign(kept.positions.begin(), kept.positions.end());
    executor_.smoother->positions_replaced();
    at_ = {{kept.iteration, 0}};
    brought_ = at_;
  }
  while (at_.moment.iteration < target.iteration) step(StepUnit::Iteration, progress);
  if (target.visits > at_.moment.visits) visit(target.visits - at_.moment.visits, progress);
}

Outcome Run::iterate(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return advance({.patience = iterations, .max_iterations = iterations, .rise = ConvergenceLimits{}.rise}, false, progress, after);
}

Outcome Run::until_converged(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return advance(limits, true, progress, after);
}

Outcome Run::advance(const ConvergenceLimits& limits, bool stop_when_still, Progress& progress, const AfterIteration& after) {
  Outcome outcome{.limits = limits};
  recover();
  // Where we stand now may be the midst of an iteration, of which the history has no record.
  const Statistics start = recovering([this] { return statistics(); });
  double minimum = start.minimum, movable = start.movable_minimum;
  std::uint64_t since_rise = 0;
  bool stopped = false;
  while (!stopped && outcome.iterations < limits.max_iterations) {
    const bool whole = at_.moment.visits == 0;
    step_within(outcome.iterations, limits.max_iterations, progress);
    ++outcome.iterations;
    ++since_rise;
    const Statistics& now = history_.records()[at_.moment.iteration].statistics;
    // As differences: where nothing is movable both are infinite, and that is no rise.
    if (now.minimum - minimum >= limits.rise || now.movable_minimum - movable >= limits.rise) {
      since_rise = 0;
      outcome.last_rise = at_.moment.iteration;
      minimum = std::max(minimum, now.minimum);
      movable = std::max(movable, now.movable_minimum);
    }
    if (after) recovering([&] { after(*this); });
    const bool still = whole && last_moved_ == 0;
    stopped = stop_when_still && (still || since_rise >= limits.patience);
    if (stopped) outcome.reason = still ? StopReason::NothingMoved : StopReason::NoRise;
  }
  last_outcome_ = outcome;
  return outcome;
}

void Run::step_within(std::uint64_t done, std::uint64_t all, Progress& progress) {
  progress_span_ = 1.0 / static_cast<double>(all);
  progress_base_ = static_cast<double>(done) * progress_span_;
  const auto whole_again = [this](void*) {
    progress_base_ = 0.0;
    progress_span_ = 1.0;
  };
  const std::unique_ptr<void, decltype(whole_again)> guard(this, whole_again);
  step(StepUnit::Iteration, progress);
}

}  // namespace dmoscope
