// Rise of a cluster's mean: the minimum, as good as it can be within half of the gap, gives up the other half for it. Single vertices could
// not do this: where all have an element at the minimum, none can move alone.

#include <algorithm>

#include "core/joint/cluster_search.h"
#include "core/joint/defined_atoms.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr double kMeanGap = 1e-3;  // relative, of the sum of 1 / quality
constexpr double kRoom = 1e-9;     // relative, for atoms at their limits
// Margins for coordinates that are rounded: a share of the way from the minimum to the floor, and a share of a step.
constexpr double kMargin = 0.1, kStepMargin = 1e-5;
constexpr int kMostHalvings = 4;
constexpr int kMostSteps = 40;  // limit of Newton steps: enough in the plane; on curved surfaces later ones gain next to nothing

/// Greatest of the harmonic mean's steps that a quality reaches; a quality above it must stay above it.
double step_below(double quality) {
  double reached = 0.0;
  for (const double step : kMeanSteps)
    if (quality >= step) reached = std::max(reached, step);
  return reached;
}

/// Mean and least of elements' qualities.
struct MeanAndLeast {
  double mean, least;
};
MeanAndLeast mean_and_least(const InputMesh& input, Metric metric, MeanKind kind, std::span<const Index> elements,
                            std::span<const Vec3> positions) {
  PowerMean<double> mean(kind);
  double least = HUGE_VAL;
  for (const Index e : elements) {
    const double quality = element_quality(input.quality_context(), positions, metric, e);
    mean.join(mean.term(quality));
    least = std::min(least, quality);
  }
  return {mean.value(static_cast<double>(elements.size())), least};
}

}  // namespace

/// Raises the worst atom where the smallest cluster around it holds it; else none, and nothing is changed. A push would gain nothing for
/// the minimum there, and let others become almost as bad for the mean.
template <int D>
std::optional<JointCluster> ClusterSearch<D>::held_at_once() {
  const JointState before = state_;
  if (const std::optional<Index> worst = find_worst())
    if (JointCluster cluster = raise(*worst, 0); cluster.certified) return cluster;
  take_back();
  holds_ = false;
  state_ = before;
  return std::nullopt;
}

/// Raises the mean; no element becomes worse than the gap allows, or than the worst element was before this call. Sliding vertices slide
/// here, too.
template <int D>
void ClusterSearch<D>::raise_mean(const std::vector<Index>& cluster) {
  const JointSolution<D>& raised = solved_.solution;
  const bool done = raised.end == InteriorPointEnd::Gap || raised.end == InteriorPointEnd::LeftEarly;
  if (!done || !is_last_aim()) return;  // the metric that is raised then is not that of the mean
  const double bound = function_.quality_of(raised.last.tau - raised.last.gap());
  const double floor = std::max((1.0 - options_.gap) * bound, function_.quality_of(raised.start_worst));
  Solved better = posed(cluster);
  JointProblem<D>& problem = better.local.problem;
  const std::span<const Index> free = better.local.free();
  const std::vector<Index> elements = mesh_.elements_at(free);
  const auto judged = [&] { return mean_and_least(mesh_.input(), mesh_.metric(), *options_.mean, elements, positions_); };
  const MeanAndLeast before = judged();
  if (!(before.least > 0.0)) return;  // the qualities may be of a formula or of an inverted element
  const double lowest = floor + kMargin * (function_.quality_of(1.0 / reached()) - floor);
  std::vector<double> limits;
  for (std::size_t a = 0; a < problem.raised(); ++a) {
    const double f = function_.value(problem.atoms[a], problem.edges[a], problem.reference(a));
    const bool steps = *options_.mean == MeanKind::Harmonic && problem.atoms[a].piece != kGuardPiece;
    const double kept = std::max(lowest, (1.0 + kStepMargin) * (steps ? step_below(function_.quality_of(f)) : 0.0));
    limits.push_back(std::max(function_.inverse_of(kept), (1.0 + kRoom) * f));
  }
  problem.beside = problem.limits.size();
  problem.limits.insert(problem.limits.begin(), limits.begin(), limits.end());
  if (problem.limited == nullptr) problem.limited = &function_;
  const int steps = std::min(options_.max_steps, kMostSteps);
  better.solution = solve_joint<D>(problem, function_, {.gap = kMeanGap, .max_steps = steps, .pool = options_.pool}, {}, progress_);
  newton_steps_ += better.solution.last.steps;
  ++solutions_;
  if (!(better.solution.best_worst < better.solution.start_worst)) return;

  double share = 1.0;
  for (int i = 0; i <= kMostHalvings; ++i, share *= 0.5) {
    std::vector<Vec3> targets = targets_of(better, share);
    if (problem.path != nullptr) (void)better.path->settle(share, free, positions_, targets);
    const std::vector<double> guarded_before = guarded(elements);
    const JudgedMove move = mesh_.move_to(better.local, targets, positions_, mesh_.metric());
    const MeanAndLeast after = judged();
    const bool good = after.mean > before.mean && after.least >= std::min(before.least, floor) &&
                      move.inverted_after <= move.inverted_before && keeps_others(elements, guarded_before);
    for (std::size_t k = 0; k < move.moved_from.size(); ++k) {
      if (good)
        moved_from_.emplace_back(free[k], move.moved_from[k]);
      else
        positions_[free[k]] = move.moved_from[k];
    }
    if (good) return;
  }
}

template std::optional<JointCluster> ClusterSearch<2>::held_at_once();
template std::optional<JointCluster> ClusterSearch<3>::held_at_once();
template void ClusterSearch<2>::raise_mean(const std::vector<Index>&);
template void ClusterSearch<3>::raise_mean(const std::vector<Index>&);

}  // namespace dmoscope
