// Joint moves within the method's phase: they untangle, raise what it is stuck in, and certify its minimum. Where nothing slides they look
// at a region of the mesh alone.

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/stopwatch.h"
#include "core/input/mesh_region.h"
#include "core/input/mesh_share.h"
#include "core/inspect/joint_hold.h"
#include "core/reference/domain.h"
#include "core/run/run.h"
#include "core/run/surface_fit.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

constexpr std::size_t kMostVertices = 1U << 20U;  // limit for the vertices of a region

/// Elements of this process that satisfy `is_seed`, ascending.
template <class IsSeed>
std::vector<Index> elements_that(const InputMesh& input, IsSeed is_seed) {
  std::vector<Index> seeds;
  for (Index e = 0; e < input.mesh.elements.size(); ++e)
    if (is_seed(e)) seeds.push_back(e);
  return seeds;
}

}  // namespace

bool Run::knows_joint_moves() const {
  const bool cannot = input_->is_surface() || !why_not_joint(*input_, parameters_.metric).empty();  // a region knows no domain
  return method_info(parameters_.method).optimises && !(input_->share ? input_->share->any(cannot) : cannot);
}

/// Returns whether the next iteration, of the method's phase, moves vertices around inverted elements together. A share's regions know no
/// targets and fields of the whole mesh.
bool Run::joint_untangling_follows(std::uint64_t iteration) const {
  const bool can =
      method_info(parameters_.method).optimises && !input_->is_surface() && (!input_->share || is_built_in(parameters_.metric));
  return can && phases().of(iteration + 1) == Phase::Method && untangles_jointly(history_.records(), iteration, input_->has_strays);
}

/// Makes an iteration in which vertices around inverted elements move together, from the end of one or after edits there.
void Run::untangle_jointly(Progress& progress) {
  const std::uint64_t iteration = at_.moment.iteration + 1;
  const Stopwatch watch;
  recovering([this] { download(); });
  std::vector<Vec3> positions(positions_.host().begin(), positions_.host().end());
  JointOptions options;
  options.pool = pool_.get();
  options.on_step = [&](const JointStep&) {
    if (observer_) observer_(*this);
  };
  std::optional<JointCluster> found;
  if (domain_ || !is_built_in(parameters_.metric)) {
    const JointSliding sliding{domain_, parameters_.max_deviation * input_->geometry.size};
    found = untangle(*input_, parameters_.metric, fixed_, sliding, positions, options, progress);
  } else if (const auto region = region_of_inverted(positions)) {
    std::vector<Vec3> places = region->input->mesh.positions;
    found = untangle(*region->input, parameters_.metric, region->fixed, {}, places, options, progress);
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const Index v = find_vertex(*input_, region->vertices[i]); v != kNoIndex) positions[v] = places[i];
  }
  last_moved_ = found ? found->moved.size() : 0;
  put(positions, {{iteration}});
  record({.moment = {iteration}, .moved = last_moved_, .seconds = watch.seconds()});
}

/// Makes the iteration that draws vertices to the surface of another mesh.
void Run::fit(Progress& progress) {
  constexpr double kTangled = 0.05;  // floor of the guard's metric where the input is tangled
  const Stopwatch watch;
  std::vector<Vec3> positions(positions_.host().begin(), positions_.host().end());
  SmoothingTask task = this->task();
  if (const auto& rule = parameters_.guard; rule && !task.guard) {
    const double least = compute_statistics(input_->quality_context(), positions, rule->metric, immovable_, pool_.get()).movable_minimum;
    task.guard = Guard{rule->metric, rule->floor.value_or(least > 0.0 ? least : kTangled)};
  }
  last_moved_ = fit_to_surface(task, fixed(), parameters_.fit, positions, progress);
  const std::uint64_t iteration = at_.moment.iteration + 1;
  put(positions, {{iteration}});
  record({.moment = {iteration}, .moved = last_moved_, .seconds = watch.seconds()});
}

/// Region around inverted elements, as large as can be taken together.
std::optional<MeshRegion> Run::region_of_inverted(std::span<const Vec3> positions) const {
  constexpr int kMostRings = 254, kFewRings = 6;
  const QualityContext context = input_->quality_context();
  const std::vector<Index> seeds = elements_that(*input_, [&](Index e) { return smallest_jacobian(context, positions, e) <= 0.0; });
  auto region = region_around(*input_, positions, fixed_, seeds, kMostRings, kMostVertices);
  return region ? std::move(region) : region_around(*input_, positions, fixed_, seeds, kFewRings, kMostVertices);
}

/// Returns whether look_at_worst() can find a raise of the worst element. Where vertices slide it would hold them: a region knows no
/// domain, nor the targets and fields of the whole mesh that a defined metric may ask for.
bool Run::can_raise_worst() const {
  const bool is_plain = !method_info(parameters_.method).joint && !parameters_.combination && !domain_;
  return is_plain && is_built_in(parameters_.metric) && knows_joint_moves();
}

/// Returns whether a certificate of the minimum ends the run.
bool Run::can_be_certified() const { return !parameters_.then_joint && !parameters_.then_mean && can_raise_worst(); }

/// Finds the joint move of vertices around the worst element that can move, at an iteration's end, on a copy.
RaiseOfWorst Run::look_at_worst(Progress& progress) {
  constexpr std::size_t kAtMost = 500;  // limit for the vertices: it is asked while others still move
  constexpr double kNoGain = 2e-3;      // rise of the minimum that is too little: finer than what single vertices find
  constexpr double kRounding = 1e-9;
  const int rings = input_->is_volume() ? 6 : 16;
  RaiseOfWorst look;
  look.iteration = at_.moment.iteration;
  const double movable_minimum = history_.records()[look.iteration].statistics.movable_minimum;
  const Stopwatch watch;
  recovering([this] { download(); });
  const std::span<const Vec3> positions = positions_.host();
  const QualityContext context = input_->quality_context();
  auto immovable = immovable_.begin();
  const auto is_worst = [&](Index e) {
    if (immovable != immovable_.end() && *immovable == e) return ++immovable, false;
    return element_quality(context, positions, parameters_.metric, e) == movable_minimum;
  };
  const auto region = region_around(*input_, positions, fixed_, elements_that(*input_, is_worst), rings, kMostVertices);
  if (!region) return look;
  const InputMesh& part = *region->input;
  const auto found = joint_hold(part, part.mesh.positions, region->fixed, {}, parameters_.metric, kAtMost, pool_.get(), progress, {});
  look.seconds = watch.seconds();
  if (!found) return look;
  // The worst elements do not change with any vertex that may move: their worst corners are those of fixed vertices alone.
  const bool held_for_good = found->before > (1.0 + kRounding) * movable_minimum;
  if (held_for_good) {
    look.certified = true;
  } else if (found->after - found->before > kNoGain * found->before) {
    for (const JointCluster::Moved& moved : found->moved)
      if (const Index v = find_vertex(*input_, region->vertices[moved.vertex]); v != kNoIndex) look.moved.push_back({v, moved.to});
    look.count = found->moved.size();
    look.figures = {.certified = found->certified,
                    .bound = found->bound,
                    .gap = found->gap,
                    .vertices = static_cast<Index>(found->vertices.size()),
                    .newton_steps = found->newton_steps};
  } else {
    look.certified = found->certified && std::ranges::none_of(found->active, [&](const JointCluster::Active& each) {
                       return region->touches_rim(each.element);
                     });
  }
  return look;
}

/// Makes the next iteration do the joint move that a look at the end of the last one found, if it gains.
bool Run::raise_follows_look(RaiseOfWorst look) {
  if (look.figures.vertices == 0) return false;
  history_.raise_after_last();
  next_raise_ = std::move(look);
  return true;
}

/// Returns whether the next iteration, of the method's phase, moves vertices around the worst element together.
bool Run::raise_of_worst_follows(std::uint64_t iteration) const {
  return history_.records()[iteration].raise_follows && edits_.count_at({iteration}) == 0;
}

/// Makes an iteration in which vertices around the worst element move together, from the end of one.
void Run::raise_worst_jointly(Progress& progress) {
  const bool known = next_raise_ && next_raise_->iteration == at_.moment.iteration;
  const RaiseOfWorst raise = known ? *std::exchange(next_raise_, std::nullopt) : look_at_worst(progress);
  recovering([this] { download(); });
  std::vector<Vec3> positions(positions_.host().begin(), positions_.host().end());
  for (const JointCluster::Moved& moved : raise.moved) positions[moved.vertex] = moved.to;
  last_moved_ = raise.count;
  const std::uint64_t iteration = raise.iteration + 1;
  put(positions, {{iteration}});
  record({.moment = {iteration}, .moved = last_moved_, .seconds = raise.seconds, .joint = raise.figures});
}

}  // namespace dmoscope
