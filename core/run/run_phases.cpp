// The phases of a run: where they begin, and the iterations of joint moves.

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/stopwatch.h"
#include "core/reference/domain.h"
#include "core/run/run.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

JointOptions joint_options(const RunParameters& parameters, const std::optional<Guard>& guard) {
  JointOptions options;
  options.gap = parameters.joint_gap;
  options.push_first = true;  // it raises the mean as well
  options.push_gap = std::max(options.push_gap, options.gap);
  if (parameters.then_mean && !parameters.combination) options.mean = parameters.mean;
  options.guard = guard;
  return options;
}

/// Progress of a cluster, 0 to 1, by how far it still is from its bound.
double share_done(double gap, double goal) { return gap > 0.0 ? std::clamp(std::log(gap) / std::log(goal), 0.0, 1.0) : 1.0; }

}  // namespace

RunPhases Run::phases() const {
  RunPhases all;
  const bool joint_is_first = method_info(parameters_.method).joint;
  all.joint_since = joint_since();
  if (all.joint_since) all.joint_over = joint_over();
  all.mean_since = mean_since();
  if (all.joint_since && !joint_is_first)
    all.joint_from = first_phase_best();
  else if (all.mean_since && !joint_is_first)
    all.mean_from = first_phase_best();
  return all;
}

/// Iteration at whose end the method's phase is over, where another comes after it.
std::optional<std::uint64_t> Run::first_phase_end() const {
  const PhaseBegin* next = next_phase(parameters_);
  if (next == nullptr) return std::nullopt;
  return turn_.find(*next, history_.records(), still_iterations(method_info(parameters_.method), parameters_.options, input_->is_volume()),
                    parameters_.then_joint.has_value(), parameters_.fit > 0.0 ? 1 : 0);
}

/// Iteration to whose state the run goes back there, the best of the first phase; none where it goes on from the last.
std::optional<std::uint64_t> Run::first_phase_best() const {
  const auto end = first_phase_end();
  if (!end) return std::nullopt;
  const auto& records = history_.records();
  const auto best = next_phase_start(parameters_, records, *end);
  return best && same_state(records[*best].statistics, records[*end].statistics) ? best : std::nullopt;
}

std::optional<std::uint64_t> Run::joint_since() const {
  if (method_info(parameters_.method).joint) return 0;
  return parameters_.then_joint ? first_phase_end() : std::nullopt;
}

std::optional<std::uint64_t> Run::joint_over() const {
  const auto since = joint_since();
  const auto& records = history_.records();
  if (!since || *since >= records.size()) return std::nullopt;
  const auto over = std::find_if(records.begin() + static_cast<std::ptrdiff_t>(*since), records.end(),
                                 [](const IterationRecord& record) { return record.joint && record.joint->end != JointState::End::None; });
  return over == records.end() ? std::nullopt : std::optional(over->iteration);
}

std::optional<std::uint64_t> Run::mean_since() const {
  if (!parameters_.then_mean) return std::nullopt;
  if (!parameters_.then_joint && !method_info(parameters_.method).joint) return first_phase_end();
  return joint_over();
}

/// Returns whether the next iteration is one of joint moves.
bool Run::joint_follows(std::uint64_t iteration) const {
  const auto joint = joint_since();
  if (!joint || *joint > iteration) return false;
  const auto mean = mean_since();
  return !mean || *mean > iteration;
}

std::shared_ptr<const JointStanding> Run::joint_standing() const {
  const std::uint64_t iteration = at_.moment.iteration;
  if (!joint_follows(iteration)) return nullptr;
  const std::uint64_t since = *joint_since();
  auto state = iteration > since ? joint_course_.state_after(iteration, since) : std::nullopt;
  return state ? std::make_shared<const JointStanding>(JointStanding{iteration, std::move(*state)}) : nullptr;
}

/// Guard of joint moves; none where the input is tangled, for what is untangled may be below its floor.
std::optional<Guard> Run::joint_guard() const { return history_.records().front().statistics.inverted == 0 ? guard_ : std::nullopt; }

/// Aims of joint moves. A guard is a first aim that is reached already.
JointObjective Run::joint_aims() const {
  const std::optional<Guard> guard = joint_guard();
  if (!guard || parameters_.combination) return {parameters_.metric, parameters_.combination};
  const JointObjective guarded(guard->metric, CompositeTerms{std::nextafter(guard->floor, 0.0), parameters_.metric});
  return why_not_joint(*input_, guarded).empty() ? guarded : JointObjective(parameters_.metric);
}

JointClusters& Run::joint_clusters() {
  if (!joint_clusters_)
    joint_clusters_ = std::make_unique<JointClusters>(*input_, joint_aims(), fixed_,
                                                      JointSliding{domain_, parameters_.max_deviation * input_->geometry.size});
  return *joint_clusters_;
}

/// Makes an iteration of joint moves, which is a cluster, from the end of an iteration or after edits there. Where too little is known to
/// go on from here, goes back to the begin of the phase instead.
void Run::move_jointly(Progress& progress) {
  const std::uint64_t iteration = at_.moment.iteration, since = *joint_since();
  const Stopwatch watch;
  recovering([this] { download(); });
  std::vector<Vec3> positions(positions_.host().begin(), positions_.host().end());
  if (const auto known = joint_course_.find(iteration + 1)) {
    if (known->cluster)
      for (const JointCluster::Moved& moved : known->cluster->moved) positions[moved.vertex] = moved.to;
    end_joint_iteration(positions, *known, watch.seconds());
    return;
  }
  const bool anew = at_.moment.edits > 0;
  std::optional<JointState> before = anew ? JointState{} : joint_course_.state_after(iteration, since);
  if (!before) return restore(since);
  JointOptions options = joint_options(parameters_, joint_guard());
  options.pool = pool_.get();
  options.on_step = [&](const JointStep& step) {
    progress.set(share_done((step.bound - step.minimum) / step.bound, options.gap));
    if (observer_) observer_(*this);
  };
  JointState after = *before;
  auto cluster = joint_clusters().raise_worst(positions, after, options, progress);
  joint_course_.add(iteration + 1, *before, std::move(after), std::move(cluster), anew);
  end_joint_iteration(positions, *joint_course_.find(iteration + 1), watch.seconds());
}

void Run::end_joint_iteration(std::span<const Vec3> positions, const JointIteration& done, double seconds) {
  JointFigures figures;
  std::uint64_t moved = 0;
  if (done.cluster) {
    const JointCluster& cluster = *done.cluster;
    figures = {JointState::End::None, cluster.certified, cluster.is_push,
               cluster.bound,         cluster.gap,       static_cast<Index>(cluster.vertices.size()),
               cluster.newton_steps,  cluster.beyond};
    moved = cluster.moved.size();
  } else {
    figures.end = done.rest.end;
  }
  const std::uint64_t iteration = at_.moment.iteration + 1;
  put(positions, {{iteration}});
  record({.moment = {iteration}, .moved = moved, .seconds = seconds, .joint = figures});
  last_moved_ = moved;
}

}  // namespace dmoscope
