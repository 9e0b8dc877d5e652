// Report of a call in the mesh's terms: how far the minimum rose, what holds it, and why it is not certified.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/same_bits.h"
#include "core/joint/cluster_search.h"
#include "core/quality/quality.h"

namespace dmoscope {

template <int D>
std::string ClusterSearch<D>::why_not(const std::vector<Index>& cluster) const {
  const JointSolution<D>& solution = solved_.solution;
  if (holds_) return "with those that slide no step was found that leads further";
  if (solution.end == InteriorPointEnd::Steps) return fmt::format("{} Newton steps did not suffice", options_.max_steps);
  if (solution.end == InteriorPointEnd::Enough) return "it is beyond the threshold, where the second aim counts";
  if (solution.end != InteriorPointEnd::Gap) return "no step was found that leads further";
  if (!(solved_.rim_share < kClosedRim))
    return fmt::format("{:.2g} % of what holds it lies on the rim of the {} vertices, and {}", 100.0 * solved_.rim_share, cluster.size(),
                       options_.cluster_at_most > 0 ? "no more are tried here" : "they are as many as may move together");
  const double bound = 1.0 / (solution.last.tau - solution.last.gap());
  if (const std::size_t stopped = count_stopped(); stopped > 0)
    return fmt::format("{} holds {} of those that slide", D == 2 ? "the bound of deviation" : "the bound of deviation, or a feature edge,",
                       stopped);
  if (!(bound - reached() <= 4.0 * options_.gap * bound)) return "the metric as judged did not rise as the solution did";
  return {};
}

/// Number of vertices of the active atoms that are drawn to a place which the bound of deviation forbids.
template <int D>
std::size_t ClusterSearch<D>::count_stopped() const {
  if (solved_.local.problem.path == nullptr) return 0;
  const std::vector<Index> stopped = solved_.path->stopped();
  const JointIterate<D>& at = solved_.solution.last;
  const auto count = static_cast<double>(at.multipliers.size());
  std::set<Index> found;
  for (std::size_t i = 0; i < at.multipliers.size(); ++i) {
    if (!is_near(at, i, kNearTau) || at.multipliers[i] <= kNoticed / count) continue;
    for (const Index v : atom(i).vertices)
      if (std::ranges::binary_search(stopped, v)) found.insert(v);
  }
  return found.size();
}

template <int D>
JointCluster ClusterSearch<D>::told(const std::vector<Index>& cluster) const {
  JointCluster result;
  result.vertices = cluster;
  result.beyond = first_ != nullptr;
  result.aim = aim();
  result.newton_steps = newton_steps_;
  result.solutions = solutions_;
  const double bound = solved_.solution.last.tau - solved_.solution.last.gap();
  result.bound = function_.quality_of(bound);
  const double least = reached();
  result.gap = std::max(0.0, (1.0 / bound - least) / least);

  std::vector<Vec3> old(positions_.begin(), positions_.end());
  for (auto move = moved_from_.rbegin(); move != moved_from_.rend(); ++move) old[move->first] = move->second;
  for (const Index v : cluster)
    if (!same_bits(old[v], positions_[v])) result.moved.push_back({v, positions_[v]});
  const QualityContext context = mesh_.input().quality_context();
  result.before = result.after = HUGE_VAL;
  for (const Index e : mesh_.elements_at(cluster)) {
    const double before = element_quality(context, old, mesh_.metric(), e);
    const double after = element_quality(context, std::span<const Vec3>(positions_), mesh_.metric(), e);
    if (before == after) continue;
    result.before = std::min(result.before, before);
    result.after = std::min(result.after, after);
  }
  tell_forces(result);
  return result;
}

template <int D>
std::string ClusterSearch<D>::aim() const {
  if (first_ == nullptr) return threshold_ < HUGE_VAL ? fmt::format("the least {}", info(mesh_.metric()).name) : std::string();
  return fmt::format("the least {} and keeps {} above {}", info(mesh_.metric()).name, info(first_->metric()).name, threshold_);
}

template <int D>
void ClusterSearch<D>::tell_forces(JointCluster& result) const {
  const JointIterate<D>& at = solved_.solution.last;
  const auto count = static_cast<double>(at.multipliers.size());
  double sum = 0.0;
  for (const double multiplier : at.multipliers)
    if (multiplier > kNoticed / count) sum += multiplier;
  AtomDerivatives<D> derivatives;
  const auto& problem = solved_.local.problem;
  std::map<Index, double> active;  // multipliers by element
  for (std::size_t i = 0; i < at.multipliers.size(); ++i) {
    if (!(at.multipliers[i] > kNoticed / count)) continue;
    const Atom<D>& atom = this->atom(i);
    const double share = at.multipliers[i] / sum;
    active[atom.element] += share;
    const AtomFunction<D>& function = i < problem.raised() ? function_ : *problem.limited;
    function.derive(atom, displaced_edges<D>(problem, i, at.displacements), problem.reference(i), Curvature::Exact, derivatives);
    // Takes the gradient of q = 1 / f at f = tau, near which all atoms are that hold the cluster.
    const double factor = -share * solved_.local.scale / (at.tau * at.tau);
    std::array<std::array<double, D>, D + 1> forces{};
    for (std::size_t j = 0; j < D; ++j)
      for (std::size_t r = 0; r < D; ++r) {
        forces[j + 1][r] = factor * derivatives.gradient[j * D + r];
        forces[0][r] -= forces[j + 1][r];
      }
    for (std::size_t k = 0; k <= D; ++k) result.forces.push_back({atom.element, atom.vertices[k], mesh_.lifted(forces[k])});
  }
  for (const auto& [element, multiplier] : active) result.active.push_back({element, multiplier});
  std::ranges::stable_sort(result.active, [](const auto& a, const auto& b) {
    return a.multiplier != b.multiplier ? a.multiplier > b.multiplier : a.element < b.element;
  });
  std::ranges::stable_sort(
      result.forces, [](const auto& a, const auto& b) { return a.element != b.element ? a.element < b.element : a.vertex < b.vertex; });
  std::vector<JointCluster::Force> merged;  // forces of an element's atoms added up
  for (const JointCluster::Force& each : result.forces) {
    const bool same = !merged.empty() && merged.back().element == each.element && merged.back().vertex == each.vertex;
    if (same)
      merged.back().force = merged.back().force + each.force;
    else
      merged.push_back(each);
  }
  result.forces = std::move(merged);
}

template std::string ClusterSearch<2>::why_not(const std::vector<Index>&) const;
template JointCluster ClusterSearch<2>::told(const std::vector<Index>&) const;
template std::string ClusterSearch<3>::why_not(const std::vector<Index>&) const;
template JointCluster ClusterSearch<3>::told(const std::vector<Index>&) const;

}  // namespace dmoscope
