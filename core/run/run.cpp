#include "core/run/run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "core/input/mesh_share.h"
#include "core/mesh/thin.h"
#include "core/quality/metric_phrase.h"
#include "core/reference/domain.h"
#include "core/run/run_task.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/choose_executor.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

std::vector<std::uint8_t> fixed_vertices(const InputMesh& input, const RunParameters& parameters, const Domain* domain) {
  std::vector<std::uint8_t> fixed = standing_vertices(input, parameters.standing(), domain);
  for (const Index v : parameters.fixed) {
    if (v >= fixed.size()) throw UsageError(fmt::format("fixed vertex {} does not exist: the mesh has {} vertices", v, fixed.size()));
    fixed[on_front(input.mesh, v)] = 1;
  }
  if (input.share) input.share->agree(fixed);
  for (const Partners& pair : domain != nullptr ? domain->pairs() : std::span<const Partners>())  // the fixed one holds its partner
    fixed[pair.first] = fixed[pair.second] = fixed[pair.first] | fixed[pair.second];
  return fixed;
}

/// Free vertices in the order of the visits, without those that are visited with others.
std::vector<Index> free_vertices(std::span<const std::uint8_t> fixed, const VisitOrder& order, const Domain* domain) {
  std::vector<Index> free;
  reserve_large(free, fixed.size());
  for (Index v = 0; v < fixed.size(); ++v)
    if (fixed[v] == 0 && (domain == nullptr || domain->leader(v) == kNoIndex)) free.push_back(v);
  return order.seed ? shuffled(free, *order.seed) : free;
}

std::shared_ptr<const Colouring> make_colouring(const InputMesh& input, std::span<const std::uint8_t> fixed, const VisitOrder& order,
                                                const Domain* domain, ThreadPool* pool) {
  if (input.share) {
    if (order.seed) throw UsageError("several processes visit the vertices in their natural order alone");
    return std::make_shared<const Colouring>(input.share->colour(input.mesh, input.geometry, input.topology, fixed, pool));
  }
  Colouring colouring = colour_vertices(input.mesh, input.topology, free_vertices(fixed, order, domain), pool,
                                        domain != nullptr ? domain->followers() : std::span<const Index>());
  arrange_classes(colouring, input.mesh, input.is_volume() ? nullptr : &input.geometry.plane, input.topology, pool);
  return std::make_shared<const Colouring>(std::move(colouring));
}

std::shared_ptr<const PlaceAim> make_place_aim(const std::shared_ptr<const InputMesh>& input,
                                               const std::optional<CompositeTerms>& combination) {
  const SizeFunction* function = combination ? combination->size() : nullptr;
  if (input->geometry.shape != Shape::Planar) return nullptr;  // refused by require_possible()
  return function != nullptr ? find_place_aim(combination->place)->make(input, *function) : nullptr;
}

/// Least quality of the elements that can move and are not inverted at their corners; +infinity where there is none.
double least_of_sound(const InputMesh& input, Metric metric, std::span<const Index> immovable) {
  const QualityContext context = input.quality_context();
  const std::span<const Vec3> positions = input.mesh.positions;
  double least = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    if (std::ranges::binary_search(immovable, e)) continue;
    const double quality = element_quality(context, positions, metric, e);
    if (quality > 0.0) least = std::min(least, quality);
  }
  return input.share ? -input.share->greatest(-least) : least;
}

/// Guard of a run. Of a tangled mesh the sound elements have what is to be kept: an element that is untangled below that falls no further.
std::optional<Guard> find_guard(const InputMesh& input, const RunParameters& p, std::span<const Index> immovable, ThreadPool* pool) {
  const auto* second = p.combination ? std::get_if<Metric>(&p.combination->second) : nullptr;
  const bool aimed = !target_of(p.metric).is_ideal() || (second != nullptr && !target_of(*second).is_ideal());
  if (!p.guard || p.guard->metric == p.metric || aimed) return std::nullopt;
  if (p.guard->floor) return Guard{p.guard->metric, *p.guard->floor};
  const QualityContext context = input.quality_context();
  const Statistics of_input = input.share ? input.share->statistics(context, input.mesh.positions, p.guard->metric, immovable, pool)
                                          : compute_statistics(context, input.mesh.positions, p.guard->metric, immovable, pool);
  const double floor = of_input.movable_minimum > 0.0 ? of_input.movable_minimum : least_of_sound(input, p.guard->metric, immovable);
  if (std::isinf(floor)) return std::nullopt;  // no element can move, or none is sound: there is nothing to keep
  return Guard{p.guard->metric, floor};
}

void require_fit(const InputMesh& input, const RunParameters& parameters) {
  if (parameters.fit > 0.0 && !input.surface)
    throw UsageError(
        fmt::format("a fit takes the surface of another mesh, on which the vertices of {} slide: --surface FILE", input.mesh.name));
}

void require_fixed_in_place(const InputMesh& input, std::span<const std::uint8_t> fixed, const Domain* domain,
                            const BeginPositions& begin) {
  if (!begin) return;
  const std::vector<Vec3>& places = input.mesh.positions;
  if (begin->size() != places.size()) throw UsageError(fmt::format("a run begins with {} vertices, not {}", begin->size(), places.size()));
  for (Index v = 0; v < places.size(); ++v)
    if (fixed[v] != 0 && !(domain != nullptr && domain->corner(v)) && std::memcmp(&(*begin)[v], &places[v], sizeof(Vec3)) != 0)
      throw UsageError(fmt::format("vertex {} is fixed, but has moved", v));
}

std::vector<Vec3> working_copy(std::span<const Vec3> positions) {
  std::vector<Vec3> copy;
  reserve_large(copy, positions.size());
  copy.assign(positions.begin(), positions.end());
  return copy;
}

}  // namespace

Run::Run(std::shared_ptr<const InputMesh> input, RunParameters parameters, std::shared_ptr<ThreadPool> pool, std::size_t history_bytes,
         Acceleration acceleration, BeginPositions begin)
    : input_(std::move(input)),
      parameters_(std::move(parameters)),
      begin_(std::move(begin)),
      pool_(std::move(pool)),
      acceleration_(std::move(acceleration)),
      domain_(domain_for(*input_, parameters_.standing())),
      fixed_(std::make_shared<const std::vector<std::uint8_t>>(fixed_vertices(*input_, parameters_, domain_.get()))),
      colouring_(make_colouring(*input_, fixed(), parameters_.order, domain_.get(), pool_.get())),
      immovable_(immovable_elements(input_->mesh, fixed(), pool_.get())),
      aim_(make_place_aim(input_, parameters_.combination)),
      guard_(find_guard(*input_, parameters_, immovable_, pool_.get())),
      executor_(choose_executor(parameters_.backend, acceleration_, task())),
      positions_(working_copy(begin_ ? *begin_ : input_->mesh.positions)),
      blocks_(block_plan()),
      history_(history_bytes),
      first_phase_(parameters_) {
  require_fit(*input_, parameters_);
  require_fixed_in_place(*input_, fixed(), domain_.get(), begin_);
  if (begin_ && executor_.smoother) executor_.smoother->positions_replaced();  // the smoother has taken the input's positions
  history_.record_input({.statistics = statistics(), .second = second_minimum()},
                        begin_ ? begin_ : BeginPositions(input_, &input_->mesh.positions));
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

std::shared_ptr<const SizeField> Run::size_field() const { return std::dynamic_pointer_cast<const SizeField>(aim_); }

std::string Run::title() const {
  if (!given_name_.empty()) return given_name_;
  const RunParameters& p = parameters_;
  std::string title = fmt::format("{} · {}", p.method, p.combination ? phrase(p.metric, *p.combination) : metric_phrase(p.metric));
  title += then_text(p);
  return title + other_than_usual(p, input_->is_surface()) + (begin_ ? ", continued" : "");
}

std::string Run::backend_sentence() const {
  if (executor_.backend != Backend::Cpu) return fmt::format("{}: {}", name(executor_.backend), executor_.reason);
  const unsigned threads = pool_->size();
  const std::string cpu = fmt::format("{}, {} thread{}", name(executor_.backend), threads, threads == 1 ? "" : "s");
  return executor_.reason.empty() ? cpu : fmt::format("{} ({})", cpu, executor_.reason);
}

SmoothingTask Run::task() const {
  SmoothingTask task = task_of(input_, parameters_);
  task.colouring = colouring_;
  task.aim = aim_;
  task.guard = guard_;
  task.domain = domain_;
  task.immovable = immovable_;
  task.pool = pool_.get();
  return task;
}

void Run::download() const {
  positions_.download(at_, [this](std::span<Vec3> host) { asking_device([&] { executor_.smoother->store(host, pool_.get()); }); });
}

std::span<const Vec3> Run::positions() const {
  download();
  return positions_.host();
}

Statistics Run::statistics() const {
  const std::uint64_t iteration = at_.moment.iteration;
  if (at_.moment.is_iteration_end() && iteration < history_.records().size()) return history_.records()[iteration].statistics;
  if (input_->share) return input_->share->statistics(input_->quality_context(), positions(), parameters_.metric, immovable_, pool_.get());
  if (executor_.smoother)
    if (const auto found = asking_device([this] { return executor_.smoother->statistics(); })) return *found;
  return compute_statistics(input_->quality_context(), positions(), parameters_.metric, immovable_, pool_.get());
}

std::optional<double> Run::second_minimum() const {
  const auto* second = parameters_.combination ? std::get_if<Metric>(&parameters_.combination->second) : nullptr;
  if (second == nullptr || !parameters_.then_mean) return std::nullopt;
  const QualityContext context = input_->quality_context();
  if (input_->share) return input_->share->statistics(context, positions(), *second, immovable_, pool_.get()).movable_minimum;
  return compute_statistics(context, positions(), *second, immovable_, pool_.get()).movable_minimum;
}

std::shared_ptr<const DevicePicture> Run::picture(Metric shown) const {
  return executor_.smoother ? executor_.smoother->picture(shown) : nullptr;
}

void Run::forget_after(std::uint64_t iteration) {
  history_.forget_after(iteration);
  joint_course_.forget_after(iteration);
  turn_.forget_after(iteration);
  first_phase_.forget_after(iteration);
}

Sweep Run::sweep() const {
  return sweep_after(history_.records(), at_.moment.iteration, {mean_since(), parameters_.mean}, input_->has_strays);
}

std::uint64_t Run::ask_smoother(std::uint64_t first, std::uint64_t count) {
  if (const Sweep now = sweep(); begun_ != now) {
    executor_.smoother->begin(now);
    begun_ = now;
  }
  return executor_.smoother->visit(first, count, positions_.host(), pool_.get());
}

void Run::sync_to_host() {
  recover();
  recovering([this] { download(); });
  keep();
}

bool Run::find_percentiles(const std::function<bool(double)>& go_on) {
  bool found = false;
  const std::size_t count = history_.records().size();
  for (std::uint64_t iteration = 0; iteration < count; ++iteration) {
    if (iteration < history_.percentiles().size() && history_.percentiles()[iteration].known()) continue;
    const bool here = at_.moment == Moment{iteration};
    if (!here && !history_.kept(iteration)) continue;
    if (!go_on(static_cast<double>(iteration) / static_cast<double>(count))) break;
    const auto where = here ? positions() : history_.nearest(iteration).positions;
    history_.note_percentiles(iteration, compute_percentiles(input_->quality_context(), where, parameters_.metric, pool_.get()));
    found = true;
  }
  return found;
}

void Run::rest() {
  sync_to_host();
  executor_.smoother.reset();
  joint_clusters_.reset();
}

BlockPlan Run::block_plan() const {
  if (!executor_.smoother || !executor_.smoother->positions_on_device()) return BlockPlan(BlockPlan::On::Host);
  return BlockPlan(input_->is_volume() ? BlockPlan::On::DeviceSolids : BlockPlan::On::Device);
}

void Run::ensure_smoother() {
  if (executor_.smoother) return;
  if (executor_.backend == Backend::Cpu) {  // also after a failure of a device
    executor_.smoother = make_smoother(task());
  } else {
    executor_ = make_executor(parameters_.backend, acceleration_, task());
  }
  if (executor_.smoother->positions_on_device()) executor_.smoother->positions_replaced();  // the smoother has taken the input's positions
  blocks_ = block_plan();
  begun_.reset();
}

RunSnapshot Run::point() const {
  return {at_.moment, edits_.share(), history_.shared_records(), last_outcome_, path_, joint_course_.share()};
}

void Run::recover() {
  if (failure_.empty()) return;
  executor_ = executor_after_failure(fmt::format("{} failed: {}", name(executor_.backend), failure_), task());
  failure_.clear();
  begun_.reset();
  blocks_ = block_plan();
  const History::Kept& kept = history_.nearest(at_.moment.iteration);
  const Moment of_history{kept.iteration};
  if (!positions_.host_shows() || positions_.host_shows()->moment < of_history) positions_.assign(kept.positions, {of_history});
  at_ = *positions_.host_shows();
  forget_after(at_.moment.iteration);
  ++path_;  // the CPU's last bits may be others
  const auto& [iteration, visits, edits] = at_.moment;
  executor_.warning = fmt::format("{}; the run is back at iteration {}{}, and the CPU can go on from there", executor_.reason, iteration,
                                  visits + edits == 0 ? "" : fmt::format(" and {} visits", visits + edits));
}

void Run::record(const RunProgress& done) {
  const std::uint64_t iteration = at_.moment.iteration;
  if (iteration < history_.records().size()) return;  // done before
  const auto mean = mean_since();
  history_.record(
      {iteration, statistics(), done.moved, done.seconds, done.searched, done.joint, second_minimum(), mean && *mean < iteration});
  unkept_seconds_ += done.seconds;
  if (next_phase(parameters_) != nullptr) {
    auto since = first_phase_end();
    if (since == iteration && raises_ && !looked_ && history_.records().back().statistics.inverted == 0) {
      looked_ = true;
      Progress unwatched;  // not to be cancelled: the record is not whole before the outcome is known
      if (raise_follows_look(look_at_worst(unwatched))) {
        turn_.forget_after(iteration - 1);
        since.reset();
      }
    }
    if (since == iteration)
      if (const auto best = next_phase_start(parameters_, history_.records(), iteration)) {
        history_.amend_last(history_.records()[*best]);
        return;  // begin_next_phase() brings the positions
      }
    if (!since) first_phase_.take(history_.records(), positions());
  }
  const bool dear = executor_.smoother->positions_on_device() && !worth_downloading(positions_.download_seconds(), unkept_seconds_);
  if (!history_.wants(iteration) || dear) return;
  download();
  keep();
}

/// Keeps the positions of an iteration's end, where the host has them.
void Run::keep() {
  if (!at_.moment.is_iteration_end() || !positions_.host_is_at(at_.moment)) return;
  history_.keep(at_.moment.iteration, positions_.host(), pool_.get());
  unkept_seconds_ = 0.0;
}

}  // namespace dmoscope
