#include "core/joint/cluster_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/joint/defined_atoms.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kFirstRings = 3, kMostRings = 64;
constexpr int kMostGrowths = 1000;  // more than any cluster needs
constexpr int kMostHalvings = 4;    // number of times that a way is halved that would invert elements
constexpr int kThirdGrowth = 2;     // growth from which on a cluster may become the whole mesh
constexpr double kEarlyGap = 0.05, kEarlyRim = 0.02;
constexpr double kActiveSlack = 2e-3, kActiveMultiplier = 0.01;
constexpr double kSameLevel = 1e-3, kSameMinimum = 1e-4;  // relative
constexpr double kLeastGain = 1e-4;                       // share of the minimum, in a pass
constexpr double kPassBand = 0.01;                        // how far above the minimum a pass looks, relative
constexpr double kBeyond = 0.01;                          // how far beyond the threshold the first of two aims is raised, relative
constexpr double kGapBeforeMean = 0.5;                    // share of the gap that is reached before a mean rises
constexpr double kAbove = 1e-9;                           // and the margin above it, for rounding

void sort_and_unique(std::vector<Index>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

template <int D>
ClusterSearch<D>::ClusterSearch(const JointMesh<D>& mesh, double threshold, const JointMesh<D>* first, const JointSliding& sliding,
                                std::span<Vec3> positions, JointState& state, const JointOptions& options, Progress& progress)
    : mesh_(mesh),
      first_(first),
      threshold_(threshold),
      domain_(sliding.domain.get()),
      positions_(positions),
      state_(state),
      options_(options),
      progress_(progress),
      function_(mesh.function()),
      whole_at_most_(options.whole_at_most > 0  ? options.whole_at_most
                     : mesh.input().is_volume() ? 3000
                                                : 80000),
      cluster_at_most_(options.cluster_at_most > 0 ? options.cluster_at_most
                       : mesh.input().is_volume()  ? 1500
                                                   : 80000),
      push_at_most_(options.push_at_most > 0   ? options.push_at_most
                    : mesh.input().is_volume() ? 3000
                                               : 100000) {
  if (domain_ != nullptr) limit_.emplace(*domain_, sliding.max_deviation);
}

template <int D>
ClusterSearch<D>::~ClusterSearch() {
  if (!finished_) take_back();
}

template <int D>
void ClusterSearch<D>::take_back() {
  for (auto move = moved_from_.rbegin(); move != moved_from_.rend(); ++move) positions_[move->first] = move->second;
  moved_from_.clear();
}

template <int D>
std::optional<JointCluster> ClusterSearch<D>::run() {
  begin();
  std::optional<JointCluster> result;
  const bool may_push =
      !at_end_of_range() && (first_ != nullptr || std::ranges::any_of(qualities_, [this](double q) { return q > 0.0 && q <= threshold_; }));
  if (options_.push_first && !state_.pushed && may_push) {
    state_.pushed = true;
    if (options_.mean && is_last_aim()) result = held_at_once();
    allow_above(-kInfinity);
    if (!result && mesh_.free_vertices().size() <= push_at_most_ && std::ranges::count(allowed_, 1) > 0) result = push();
  }
  if (!result && state_.end == JointState::End::None)
    if (const std::optional<Index> worst = find_worst()) result = raise(*worst, kMostGrowths);
  if (result) ++state_.clusters;
  finished_ = true;
  return result;
}

template <int D>
void ClusterSearch<D>::begin() {
  const std::size_t vertices = positions_.size();
  qualities_ = mesh_.qualities(positions_);
  frozen_.assign(vertices, 0);
  allowed_.assign(vertices, 0);
  inside_.assign(vertices, 0);
  for (std::size_t a = 0; a < qualities_.size(); ++a)
    if (qualities_[a] <= 0.0)
      for (const Index v : mesh_.input().mesh.elements.corners(mesh_.atoms()[a].element)) frozen_[v] = 1;
  if (first_ != nullptr) keep_first();
  if (!state_.atoms.empty()) return;
  state_.atoms.assign(qualities_.size(), JointState::Of::Open);
  state_.levels.assign(vertices, kInfinity);
  state_.pass_began_at = -kInfinity;
}

/// Freezes vertices of elements that are not beyond the threshold of the first of two aims, and leaves out atoms without other vertices.
template <int D>
void ClusterSearch<D>::keep_first() {
  const InputMesh& input = mesh_.input();
  std::vector<double> first(input.mesh.elements.size());
  element_qualities(input.quality_context(), positions_, first_->metric(), options_.pool, first);
  for (Index e = 0; e < first.size(); ++e)
    if (first[e] <= threshold_)
      for (const Index v : input.mesh.elements.corners(e)) frozen_[v] = 1;
  std::vector<std::uint8_t> can_move(positions_.size(), 0);
  for (const Index v : mesh_.free_vertices()) can_move[v] = frozen_[v] == 0 ? 1 : 0;
  for (std::size_t a = 0; a < qualities_.size(); ++a)
    if (std::ranges::none_of(mesh_.atoms()[a].vertices, [&](Index v) { return can_move[v] != 0; })) qualities_[a] = kInfinity;
}

// ---- choice of the atom ----

/// Finds the worst atom that is open and can be raised; sets which vertices may move for it.
template <int D>
std::optional<Index> ClusterSearch<D>::find_worst() {
  for (;;) {
    double minimum = kInfinity, worst = kInfinity;
    Index found = kNoIndex;
    for (Index a = 0; a < qualities_.size(); ++a) {
      if (qualities_[a] <= 0.0) continue;
      minimum = std::min(minimum, qualities_[a]);
      if (state_.atoms[a] != JointState::Of::Open || qualities_[a] >= worst) continue;
      worst = qualities_[a];
      found = a;
    }
    if (state_.pass_began_at == -kInfinity) state_.pass_began_at = minimum;
    if (!options_.beyond_minimum && certified_minimum()) {
      state_.end = JointState::End::Certified;
      return std::nullopt;
    }
    const bool is_enough = first_ == nullptr && worst > threshold_;
    const bool beyond_pass = is_enough || (!options_.beyond_minimum && worst > (1.0 + kPassBand) * minimum);
    if (found == kNoIndex || beyond_pass) {
      if (!next_pass()) return std::nullopt;
      continue;
    }
    allow_above(worst);
    const auto& vertices = mesh_.atoms()[found].vertices;
    if (!grown({vertices.begin(), vertices.end()}, kFirstRings).empty()) return found;
    // Closes an atom that certified ones hold already, unless it is the neighbour of an inverted element.
    const bool beside = std::ranges::any_of(vertices, [this](Index v) { return frozen_[v] != 0; });
    state_.atoms[found] = beside ? JointState::Of::Tried : JointState::Of::Closed;
  }
}

/// Returns whether the least quality of sound atoms is within the gap of the greatest one that the metric has at all.
template <int D>
bool ClusterSearch<D>::at_end_of_range() const {
  if (function_.defined() != nullptr || !is_last_aim()) return false;
  double minimum = kInfinity;
  for (const double q : qualities_)
    if (q > 0.0) minimum = std::min(minimum, q);
  return minimum < kInfinity && minimum >= (1.0 - options_.gap) * info(mesh_.metric()).highest;
}

/// Returns whether the worst atom of all is a certified one, or nothing can be better.
template <int D>
bool ClusterSearch<D>::certified_minimum() const {
  double minimum = kInfinity, closed = kInfinity;
  for (std::size_t a = 0; a < qualities_.size(); ++a) {
    if (qualities_[a] <= 0.0) continue;
    minimum = std::min(minimum, qualities_[a]);
    if (state_.atoms[a] == JointState::Of::Closed) closed = std::min(closed, qualities_[a]);
  }
  return at_end_of_range() || (closed < kInfinity && closed <= (1.0 + kSameMinimum) * minimum);
}

/// Opens the atoms again that were tried in vain, if there are any and the minimum rose. Returns false where all is over.
template <int D>
bool ClusterSearch<D>::next_pass() {
  const bool any = std::ranges::find(state_.atoms, JointState::Of::Tried) != state_.atoms.end();
  double minimum = kInfinity;
  for (const double q : qualities_)
    if (q > 0.0) minimum = std::min(minimum, q);
  if (!any || !(minimum - state_.pass_began_at >= kLeastGain)) {
    state_.end = any ? JointState::End::NoGain : JointState::End::Certified;
    return false;
  }
  std::ranges::replace(state_.atoms, JointState::Of::Tried, JointState::Of::Open);
  state_.pass_began_at = minimum;
  ++state_.passes;
  return true;
}

// ---- choice of the vertices ----

template <int D>
void ClusterSearch<D>::allow_above(double quality) {
  for (const Index v : mesh_.free_vertices()) allowed_[v] = frozen_[v] == 0 && state_.levels[v] > quality * (1.0 + kSameLevel) ? 1 : 0;
}

/// The seeds that may move, with all vertices that may within so many rings of elements around them: ascending, as many as are allowed.
template <int D>
std::vector<Index> ClusterSearch<D>::grown(std::vector<Index> seeds, int rings) const {
  const InputMesh& input = mesh_.input();
  std::vector<std::uint8_t> seen(positions_.size(), 0);
  std::vector<Index> all, next;
  sort_and_unique(seeds);
  const auto take = [&](Index v) {
    if (allowed_[v] != 0 && all.size() < cluster_at_most_) all.push_back(v);
  };
  for (const Index v : seeds) {
    seen[v] = 1;
    take(v);
  }
  for (int ring = 0; ring < rings && all.size() < cluster_at_most_; ++ring) {
    next.clear();
    for (const Index v : seeds)
      for (const Incidence& incidence : input.topology.star(v))
        for (const Index w : input.mesh.elements.corners(incidence.element)) {
          if (seen[w] != 0 || allowed_[w] == 0) continue;
          seen[w] = 1;
          next.push_back(w);
        }
    std::ranges::sort(next);
    for (const Index w : next) take(w);
    seeds.swap(next);
  }
  std::ranges::sort(all);
  return all;
}

template <int D>
std::vector<Index> ClusterSearch<D>::enlarged(const std::vector<Index>& cluster, int growth, int rings) const {
  const bool full = cluster.size() >= cluster_at_most_;
  std::vector<Index> larger;
  if (mesh_.free_vertices().size() <= whole_at_most_ && (growth >= kThirdGrowth || full)) {
    for (const Index v : mesh_.free_vertices())
      if (allowed_[v] != 0) larger.push_back(v);
    return larger;
  }
  if (full) return cluster;
  larger = grown(solved_.rim, rings);
  larger.insert(larger.end(), cluster.begin(), cluster.end());
  sort_and_unique(larger);
  return larger;
}

// ---- one cluster ----

/// Problem of a cluster at the vertices' present places, to be solved.
template <int D>
typename ClusterSearch<D>::Solved ClusterSearch<D>::posed(const std::vector<Index>& cluster) const {
  Solved posed;
  posed.local = mesh_.problem(cluster, positions_);
  if (first_ != nullptr) first_->limit(posed.local, (1.0 + kAbove) * threshold_, positions_);
  if (domain_ == nullptr) return posed;
  posed.path = std::make_unique<SlidingPath<D>>(mesh_, posed.local, positions_, *domain_, *limit_);
  if (holds_) posed.path->hold();
  posed.local.problem.path = posed.path->any() ? posed.path.get() : nullptr;
  return posed;
}

template <int D>
void ClusterSearch<D>::solve(const std::vector<Index>& cluster, const InteriorPointOptions& options, bool may_leave) {
  solved_ = posed(cluster);
  std::ranges::fill(inside_, std::uint8_t{0});
  for (const Index v : cluster) inside_[v] = 1;
  JointCallbacks<D> callbacks;
  if (may_leave)
    callbacks.leave_early = [this](const JointIterate<D>& at) {
      measure_rim(at);
      return solved_.rim_share > kEarlyRim;
    };
  std::vector<Vec3> places;
  if (options_.on_step)
    callbacks.step = [&](const JointIterate<D>& at) {
      places.clear();
      for (std::size_t i = 0; i < cluster.size(); ++i)
        places.push_back(mesh_.placed(positions_[cluster[i]], at.displacements[i], solved_.local.scale));
      options_.on_step(
          {newton_steps_ + at.steps, function_.quality_of(at.worst), function_.quality_of(at.tau - at.gap()), cluster, places});
    };
  solved_.solution = solve_joint<D>(solved_.local.problem, function_, options, callbacks, progress_);
  newton_steps_ += solved_.solution.last.steps;
  ++solutions_;
  commit();
  measure_rim(solved_.solution.last);
}

/// Moves the mesh's vertices if that is better by the program's own judgement. Goes half of the way, and so on, where elements would become
/// inverted, which the search knows by their corners alone, or the first of two aims would not stay beyond its threshold, or where sliding
/// vertices may not go all of it.
template <int D>
void ClusterSearch<D>::commit() {
  if (!(solved_.solution.best_worst < solved_.solution.start_worst)) return;
  double share = 1.0;
  for (int i = 0; i <= kMostHalvings; ++i, share *= 0.5) {
    bool less_may_do = false;
    if (try_move(share, less_may_do) || !less_may_do) return;
  }
}

/// Quality of elements by the guard's metric; empty where there is no guard.
template <int D>
std::vector<double> ClusterSearch<D>::guarded(std::span<const Index> elements) const {
  std::vector<double> qualities;
  if (!options_.guard) return qualities;
  const QualityContext context = mesh_.input().quality_context();
  for (const Index e : elements)
    qualities.push_back(element_quality(context, std::span<const Vec3>(positions_), options_.guard->metric, e));
  return qualities;
}

/// Returns whether elements that moved have more of the first aim than its threshold, and no less of the guard's metric than its floor, or
/// than before.
template <int D>
bool ClusterSearch<D>::keeps_others(std::span<const Index> elements, std::span<const double> guarded_before) const {
  const std::vector<double> now = guarded(elements);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] < std::min(options_.guard->floor, guarded_before[i])) return false;
  if (first_ == nullptr) return true;
  const QualityContext context = mesh_.input().quality_context();
  return std::ranges::all_of(
      elements, [&](Index e) { return element_quality(context, std::span<const Vec3>(positions_), first_->metric(), e) > threshold_; });
}

/// Targets of the free vertices, at a share of the way to the solution.
template <int D>
std::vector<Vec3> ClusterSearch<D>::targets_of(const Solved& solved, double share) const {
  const std::span<const Index> free = solved.local.free();
  std::vector<Vec3> targets;
  targets.reserve(free.size());
  for (std::size_t k = 0; k < free.size(); ++k) {
    auto way = solved.solution.best[k];
    for (double& x : way) x *= share;
    targets.push_back(mesh_.placed(positions_[free[k]], way, solved.local.scale));
  }
  return targets;
}

/// Goes a share of the way, if that is better.
template <int D>
bool ClusterSearch<D>::try_move(double share, bool& less_may_do) {
  const std::span<const Index> free = solved_.local.free();
  std::vector<Vec3> targets = targets_of(solved_, share);
  bool stayed = false;  // whether some sliding vertices stayed
  if (solved_.local.problem.path != nullptr) stayed = solved_.path->settle(share, free, positions_, targets) > 0;
  const std::vector<Index> elements = mesh_.elements_at(free);
  const std::vector<double> guarded_before = guarded(elements);
  const JudgedMove move = mesh_.move_to(solved_.local, targets, positions_, mesh_.metric());
  const bool inverts = move.inverted_after > move.inverted_before, keeps = keeps_others(elements, guarded_before);
  const bool better = move.after > move.before && !inverts && keeps;
  less_may_do = stayed || (D == 3 && inverts) || !keeps;
  for (std::size_t k = 0; k < move.moved_from.size(); ++k) {
    if (better)
      moved_from_.emplace_back(free[k], move.moved_from[k]);
    else
      positions_[free[k]] = move.moved_from[k];
  }
  return better;
}

template <int D>
void ClusterSearch<D>::measure_rim(const JointIterate<D>& at) {
  solved_.rim.clear();
  solved_.rim_share = 0.0;
  const auto count = static_cast<double>(at.multipliers.size());
  for (std::size_t i = 0; i < at.multipliers.size(); ++i) {
    if (!is_near(at, i, kNearTau)) continue;
    const auto& vertices = atom(i).vertices;
    if (std::ranges::none_of(vertices, [this](Index v) { return allowed_[v] != 0 && inside_[v] == 0; })) continue;
    solved_.rim_share += at.multipliers[i];
    if (at.multipliers[i] > kNoticed / count) solved_.rim.insert(solved_.rim.end(), vertices.begin(), vertices.end());
  }
  sort_and_unique(solved_.rim);
}

/// All vertices that may move, unless they are too many.
template <int D>
std::vector<Index> ClusterSearch<D>::all_or(std::vector<Index> cluster) const {
  if (mesh_.free_vertices().size() > push_at_most_) return cluster;
  std::vector<Index> all;
  for (const Index v : mesh_.free_vertices())
    if (allowed_[v] != 0) all.push_back(v);
  return all;
}

template <int D>
JointCluster ClusterSearch<D>::push() {
  const std::vector<Index> all = all_or({});
  InteriorPointOptions options{.gap = options_.push_gap, .max_steps = options_.max_steps, .pool = options_.pool};
  if (first_ == nullptr) options.enough = function_.inverse_of((1.0 + kBeyond) * threshold_);
  solve(all, options, false);
  JointCluster result = told(all);
  result.is_push = true;
  result.why_not = "the first push leaves the rest to the clusters";
  return result;
}

/// Raises an atom with the vertices around it, and then the mean, where something moved. With no growth at all: only where that certifies
/// it, and then the mean in any case; else an empty cluster, and what moved is still to be taken back.
template <int D>
JointCluster ClusterSearch<D>::raise(Index worst, int most_growths) {
  const double gap = options_.mean ? kGapBeforeMean * options_.gap : options_.gap;
  InteriorPointOptions options{.gap = gap, .early_gap = kEarlyGap, .max_steps = options_.max_steps, .pool = options_.pool};
  if (first_ == nullptr) options.enough = function_.inverse_of((1.0 + kBeyond) * threshold_);
  const auto& vertices = mesh_.atoms()[worst].vertices;
  int rings = kFirstRings;
  std::vector<Index> cluster = grown({vertices.begin(), vertices.end()}, rings);
  for (int growth = 0;; ++growth) {
    solve(cluster, options, true);
    if (solved_.rim_share < kClosedRim || solved_.solution.end == InteriorPointEnd::Enough) break;
    if (growth == most_growths) return {};
    rings = std::min(2 * rings, kMostRings);
    std::vector<Index> larger = enlarged(cluster, growth, rings);
    if (larger.size() <= cluster.size()) {
      if (solved_.solution.end == InteriorPointEnd::LeftEarly) solve(cluster, options, false);
      break;
    }
    cluster = std::move(larger);
  }
  const InteriorPointEnd end = solved_.solution.end;
  if (moved_from_.empty() && solved_.local.problem.path != nullptr && (end == InteriorPointEnd::Stuck || end == InteriorPointEnd::Steps)) {
    holds_ = true;  // the others may still move
    solve(cluster, options, false);
  }
  const std::string why_not = this->why_not(cluster);
  if (most_growths == 0 && !why_not.empty()) return {};
  std::vector<Index> moving = cluster;
  if (options_.mean && (!moved_from_.empty() || most_growths == 0)) {
    if (!std::exchange(state_.mean_raised, true)) moving = all_or(std::move(moving));
    raise_mean(moving);
  }
  JointCluster result = told(moving);
  result.worst_element = mesh_.atoms()[worst].element;
  if (result.moved.empty()) {
    result.before = result.after =
        element_quality(mesh_.input().quality_context(), std::span<const Vec3>(positions_), mesh_.metric(), result.worst_element);
  }
  result.why_not = why_not;
  result.certified = why_not.empty();
  settle(worst, result.certified);
  // Marks its other elements as tried: they would lead to the same vertices, in vain again.
  if (!result.certified && result.moved.empty())
    for (const Index a : solved_.local.atoms)
      if (state_.atoms[a] == JointState::Of::Open) state_.atoms[a] = JointState::Of::Tried;
  return result;
}

/// 1 / the greatest f of the cluster's atoms at the vertices' present places.
template <int D>
double ClusterSearch<D>::reached() const {
  double most = 0.0;
  for (const Index a : solved_.local.atoms) {
    const Atom<D>& atom = mesh_.atoms()[a];
    if (atom.piece != kGuardPiece) most = std::max(most, function_.value(atom, mesh_.edges(atom, positions_), 1.0));
  }
  return 1.0 / most;
}

/// Closes the atoms that hold the cluster, or marks the worst one as tried.
template <int D>
void ClusterSearch<D>::settle(Index worst, bool certified) {
  const JointIterate<D>& at = solved_.solution.last;
  const double level = reached();
  const auto set = [&](Index a) {
    state_.atoms[a] = certified ? JointState::Of::Closed : JointState::Of::Tried;
    if (!certified) return;
    for (const Index v : mesh_.atoms()[a].vertices) state_.levels[v] = std::min(state_.levels[v], level);
  };
  set(worst);
  for (std::size_t i = 0; i < at.multipliers.size(); ++i) {
    if (!is_near(at, i, kActiveSlack) && !(at.multipliers[i] > kActiveMultiplier)) continue;
    if (i < solved_.local.atoms.size())
      set(solved_.local.atoms[i]);
    else if (certified)
      for (const Index v : atom(i).vertices) state_.levels[v] = std::min(state_.levels[v], level);
  }
}

/// Atom of the mesh for one of the problem's.
template <int D>
const Atom<D>& ClusterSearch<D>::atom(std::size_t local) const {
  const std::size_t raised = solved_.local.atoms.size();
  return local < raised ? mesh_.atoms()[solved_.local.atoms[local]] : first_->atoms()[solved_.local.limited[local - raised]];
}

/// Returns whether an atom's f is within a share of its bound.
template <int D>
bool ClusterSearch<D>::is_near(const JointIterate<D>& at, std::size_t local, double share) const {
  const double bound = solved_.local.problem.bound(local, at.tau);
  return bound - at.values[local] <= share * bound;
}

template class ClusterSearch<2>;
template class ClusterSearch<3>;

}  // namespace dmoscope
