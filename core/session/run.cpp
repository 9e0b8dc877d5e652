#include "core/session/run.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/base/memory.h"

namespace dmoscope {

namespace {

/// Time of the visits between two looks at the cancel request.
constexpr double kBlockSeconds = 0.02;
/// Most of them: visits to vertices at rest cost next to nothing, and the next may be to others.
constexpr std::uint64_t kLargestBlock = std::uint64_t{1} << 20U;
/// Where a call is dear and a visit is not: far more than an iteration of any mesh.
constexpr std::uint64_t kLargestFarBlock = std::uint64_t{1} << 40U;
/// How fast slow visits of the past are forgotten, block by block.
constexpr double kForgetting = 0.75;

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

std::shared_ptr<const Colouring> make_colouring(const InputMesh& input, std::span<const Index> free) {
  Colouring colouring = colour_vertices(input.mesh, input.topology, free);
  arrange_classes(colouring, input.mesh, input.geometry.plane, input.topology);
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

Run::Run(std::shared_ptr<const InputMesh> input, RunParameters parameters, std::shared_ptr<ThreadPool> pool, std::size_t history_bytes)
    : input_(std::move(input)),
      parameters_(std::move(parameters)),
      pool_(std::move(pool)),
      fixed_(fixed_vertices(*input_, parameters_.fixed)),
      colouring_(make_colouring(*input_, free_vertices(fixed_, parameters_.order))),
      smoother_(make_smoother(parameters_.method, input_, colouring_, parameters_.metric, parameters_.search, pool_.get())),
      positions_(working_copy(input_->mesh.positions)),
      immovable_(immovable_elements(input_->mesh, fixed_, pool_.get())),
      history_(history_bytes) {
  if (smoother_->positions_are_far()) block_ = kLargestFarBlock;
  history_.record_input({0, statistics(), 0, 0.0}, {input_, &input_->mesh.positions});
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

std::string Run::title() const { return fmt::format("{} · {}", parameters_.method, info(parameters_.metric).name); }

std::span<const Vec3> Run::positions() const {
  smoother_->store(positions_, pool_.get());
  return positions_;
}

Statistics Run::statistics() const {
  if (moment_.visits == 0 && moment_.iteration < history_.records().size()) return history_.records()[moment_.iteration].statistics;
  if (const std::optional<Statistics> found = smoother_->statistics()) return *found;
  return compute_statistics(input_->quality_context(), positions(), parameters_.metric, immovable_, pool_.get());
}

void Run::record() {
  if (moment_.iteration < history_.records().size()) return;  // been here before
  history_.record({moment_.iteration, statistics(), moved_, seconds_}, positions(), pool_.get());
}

void Run::visit(std::uint64_t count, Progress& progress) {
  const std::uint64_t whole = visits_per_iteration();
  last_outcome_.reset();
  while (count > 0) {
    progress.check();
    const std::uint64_t block = std::min({count, whole - moment_.visits, block_});
    const auto start = std::chrono::steady_clock::now();
    moved_ += smoother_->visit(moment_.visits, block, positions_, pool_.get());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds_ += seconds;
    choose_block(block, seconds);
    moment_.visits += block;
    count -= block;
    progress.set(progress_base_ + progress_span_ * static_cast<double>(moment_.visits) / static_cast<double>(whole));
    if (moment_.visits == whole) end_iteration();
    if (observer_) observer_(*this);
  }
}

/// How many visits to make before the next look, from the time of the last ones. The result does not depend on it.
void Run::choose_block(std::uint64_t visits, double seconds) {
  visit_seconds_ = std::max(seconds / static_cast<double>(visits), kForgetting * visit_seconds_);
  const double most = static_cast<double>(smoother_->positions_are_far() ? kLargestFarBlock : kLargestBlock);
  block_ = static_cast<std::uint64_t>(std::clamp(kBlockSeconds / std::max(visit_seconds_, kBlockSeconds / most), 1.0, most));
}

void Run::end_iteration() {
  const auto start = std::chrono::steady_clock::now();
  smoother_->store(positions_, pool_.get());
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  moment_ = {moment_.iteration + 1, 0};
  record();
  last_moved_ = moved_;
  moved_ = 0;
  seconds_ = 0.0;
}

std::uint64_t Run::step(StepUnit unit, Progress& progress) {
  if (visits_per_iteration() == 0) {  // nothing is free: an iteration visits nobody
    end_iteration();
    return 0;
  }
  const std::uint64_t before = moved_;
  std::uint64_t target = visits_per_iteration();
  if (unit == StepUnit::Vertex) target = moment_.visits + 1;
  if (unit == StepUnit::Class) target = *std::ranges::upper_bound(colouring_->class_offsets, moment_.visits);
  visit(target - moment_.visits, progress);
  return (moment_.visits == 0 ? last_moved_ : moved_) - before;
}

bool Run::back(StepUnit unit, Progress& progress) {
  if (moment_ == Moment{}) return false;
  const std::uint64_t whole = visits_per_iteration();
  // The end of an iteration is the same place as the start of the next; from there "back" goes into the iteration before.
  Moment target = moment_.visits > 0 ? moment_ : Moment{moment_.iteration - 1, whole};
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
  const History::Kept& kept = history_.nearest(target.iteration);
  if (target < moment_ || kept.iteration > moment_.iteration) {
    positions_.assign(kept.positions.begin(), kept.positions.end());
    smoother_->positions_replaced();
    moment_ = {kept.iteration, 0};
    moved_ = 0;
    seconds_ = 0.0;
  }
  while (moment_.iteration < target.iteration) step(StepUnit::Iteration, progress);
  if (target.visits > moment_.visits) visit(target.visits - moment_.visits, progress);
}

Outcome Run::iterate(std::uint64_t iterations, Progress& progress, const AfterIteration& after) {
  return advance({.patience = iterations, .max_iterations = iterations, .rise = ConvergenceLimits{}.rise}, false, progress, after);
}

Outcome Run::until_converged(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after) {
  return advance(limits, true, progress, after);
}

Outcome Run::advance(const ConvergenceLimits& limits, bool stop_when_still, Progress& progress, const AfterIteration& after) {
  Outcome outcome{.limits = limits};
  // Where we stand now may be the midst of an iteration, of which the history has no record.
  const Statistics start = statistics();
  double minimum = start.minimum, movable = start.movable_minimum;
  std::uint64_t since_rise = 0;
  bool stopped = false;
  while (!stopped && outcome.iterations < limits.max_iterations) {
    const bool whole = moment_.visits == 0;
    step_within(outcome.iterations, limits.max_iterations, progress);
    ++outcome.iterations;
    ++since_rise;
    const Statistics& now = history_.records()[moment_.iteration].statistics;
    // As differences: where nothing is movable both are infinite, and that is no rise.
    if (now.minimum - minimum >= limits.rise || now.movable_minimum - movable >= limits.rise) {
      since_rise = 0;
      outcome.last_rise = moment_.iteration;
      minimum = std::max(minimum, now.minimum);
      movable = std::max(movable, now.movable_minimum);
    }
    if (after) after(*this);
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
