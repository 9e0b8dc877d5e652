#include "core/joint/untangler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/same_bits.h"
#include "core/joint/atoms.h"
#include "core/mesh/orientation.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostlyInverted = 0.3;  // share of inverted elements in a patch from which on their places tell little

/// Size of an ideal element with edges of length 1, by kind.
constexpr std::array<double, kElementKindCount> kIdealSizes{0.4330127018922193, 1.0, 0.11785113019775793, 1.0, 0.4330127018922193,
                                                            0.23570226039551587};

/// Area of a planar element, positive if it is counter-clockwise.
double area(const InputMesh& input, std::span<const Vec3> positions, Index element) {
  const Plane& plane = input.geometry.plane;
  const auto corners = input.mesh.elements.corners(element);
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    twice +=
        cross(plane.offset(positions[corners[i]], positions[corners[0]]), plane.offset(positions[corners[i + 1]], positions[corners[0]]));
  return 0.5 * twice;
}

}  // namespace

template <int D>
Untangler<D>::Untangler(const JointMesh<D>& mesh, Metric metric, const JointSliding& sliding, std::span<Vec3> positions, JointState& state,
                        const JointOptions& options, Progress& progress)
    : mesh_(mesh),
      metric_(metric),
      domain_(sliding.domain.get()),
      positions_(positions),
      state_(state),
      options_(options),
      progress_(progress),
      most_together_(options.whole_at_most > 0 ? options.whole_at_most
                     : D == 2                  ? 100000
                                               : 200000),
      before_(kInfinity),
      after_(kInfinity) {
  if (domain_ != nullptr) limit_.emplace(*domain_, sliding.max_deviation);
}

template <int D>
Untangler<D>::~Untangler() {
  if (!finished_) take_back();
}

template <int D>
void Untangler<D>::take_back() {
  for (auto move = moved_from_.rbegin(); move != moved_from_.rend(); ++move) positions_[move->first] = move->second;
  moved_from_.clear();
  vertices_.clear();
  before_ = after_ = kInfinity;
}

template <int D>
std::optional<JointCluster> Untangler<D>::run() {
  if (const std::vector<Index> inverted = inverted_elements(); !inverted.empty() && state_.untanglings < kMostCalls) {
    ++state_.untanglings;
    grow(inverted);
    if (loses_sound()) {
      take_back();
      keeps_sound_ = true;
      grow(inverted);
    }
    if (moved_from_.empty()) state_.untanglings = kMostCalls;
  }
  finished_ = true;
  if (moved_from_.empty()) return std::nullopt;
  state_.atoms.clear();  // it describes the elements before the moves
  state_.levels.clear();
  state_.pushed = state_.beyond = false;
  state_.end = JointState::End::None;
  ++state_.clusters;
  return told();
}

/// Untangles with more and more rings; where vertices slide, first without these and then, as long as patches are small, with them. Ends
/// where nothing helps.
template <int D>
void Untangler<D>::grow(std::vector<Index> inverted) {
  std::vector<Patch> before;
  for (const int rings : kRings)
    for (const bool sliding : {false, true}) {
      if (sliding && (domain_ == nullptr || rings > kMostSliding)) continue;
      slides_ = sliding;
      std::vector<Patch> groups = patches(inverted, rings);
      for (const Patch& patch : groups)
        if (std::ranges::find(before, patch) == before.end()) untangle(patch);
      inverted = inverted_elements();
      if (inverted.empty()) return;
      before = std::move(groups);
    }
}

/// Inverted elements that could be turned: the corners at fault have free vertices, or none is and it is inverted inside.
template <int D>
std::vector<Index> Untangler<D>::inverted_elements() const {
  const QualityContext context = mesh_.input().quality_context();
  std::vector<Index> result;
  Index last = kNoIndex;
  for (const Atom<D>& atom : mesh_.atoms()) {
    const bool is_first = atom.element != last;
    last = atom.element;
    if (!result.empty() && result.back() == last) continue;
    if (atom_jacobian<D>(atom.shape, mesh_.edges(atom, positions_)) <= 0.0 || (is_first && inverted_inside(context, positions_, last)))
      result.push_back(last);
  }
  return result;
}

/// Number of rings by which a free vertex is away from the inverted elements, up to `most`; kFar beyond that, and for others.
template <int D>
std::vector<int> Untangler<D>::rings_from(const std::vector<Index>& inverted, int most) const {
  const Mesh& mesh = mesh_.input().mesh;
  std::vector<std::uint8_t> movable(positions_.size(), 0);
  for (const Index v : mesh_.free_vertices()) movable[v] = slides_ || domain_ == nullptr || !domain_->slides(v) ? 1 : 0;
  std::vector<int> rings(positions_.size(), kFar);
  std::vector<Index> last, next;
  for (const Index e : inverted)
    for (const Index v : mesh.elements.corners(e)) {
      last.push_back(v);
      if (movable[v] != 0) rings[v] = 0;
    }
  for (int ring = 1; ring <= most && !last.empty(); ++ring) {
    next.clear();
    for (const Index v : last)
      for (const Incidence& incidence : mesh_.input().topology.star(v))
        for (const Index w : mesh.elements.corners(incidence.element)) {
          if (movable[w] == 0 || rings[w] != kFar) continue;
          rings[w] = ring;
          next.push_back(w);
        }
    last.swap(next);
  }
  return rings;
}

/// Connected patches of those `vertices` that are up to so many rings away, in pieces of at most `most` vertices; each ascending.
template <int D>
std::vector<typename Untangler<D>::Patch> Untangler<D>::connected(std::span<const Index> vertices, const std::vector<int>& rings, int limit,
                                                                  std::size_t most) const {
  std::vector<std::uint8_t> open(positions_.size(), 0);
  for (const Index v : vertices) open[v] = rings[v] <= limit ? 1 : 0;
  std::vector<Patch> result;
  for (const Index first : vertices) {
    if (open[first] == 0) continue;
    Patch patch{first};
    open[first] = 0;
    for (std::size_t i = 0; i < patch.size(); ++i)
      for (const Incidence& incidence : mesh_.input().topology.star(patch[i]))
        for (const Index w : mesh_.input().mesh.elements.corners(incidence.element)) {
          if (open[w] == 0 || patch.size() == most) continue;
          open[w] = 0;
          patch.push_back(w);
        }
    std::ranges::sort(patch);
    result.push_back(std::move(patch));
  }
  return result;
}

/// Connected patches of free vertices within so many rings of the inverted elements. Too large ones get fewer rings, and at last are cut.
template <int D>
std::vector<typename Untangler<D>::Patch> Untangler<D>::patches(const std::vector<Index>& inverted, int most) const {
  const std::vector<int> rings = rings_from(inverted, most);
  int limit = 0;
  for (const int ring : rings)
    if (ring != kFar) limit = std::max(limit, ring);
  std::vector<Patch> result, large{{mesh_.free_vertices().begin(), mesh_.free_vertices().end()}};
  for (bool is_last = false; !large.empty() && !is_last; limit /= 2) {
    is_last = limit == 0;
    std::vector<Patch> next;
    for (const Patch& one : large)
      for (Patch& patch : connected(one, rings, limit, is_last ? most_together_ : one.size()))
        (patch.size() <= most_together_ ? result : next).push_back(std::move(patch));
    large = std::move(next);
  }
  return result;
}

// ---- one patch ----

/// Elements at a patch's vertices, ascending.
template <int D>
std::vector<Index> Untangler<D>::elements_of(const Patch& patch) const {
  std::vector<Index> elements = mesh_.elements_at(patch);
  std::erase_if(elements, [&](Index e) { return info(mesh_.input().mesh.elements.kind(e)).dimension != D; });
  return elements;
}

template <int D>
LocalProblem<D> Untangler<D>::local_problem(const Patch& patch) const {
  LocalProblem<D> local;
  local.problem.free_vertices = patch.size();
  local.vertices = patch;
  double longest = 0.0;
  for (const Index v : patch)
    for (const Index a : mesh_.atoms_at(v))
      for (const auto& edge : mesh_.edges(mesh_.atoms()[a], positions_))
        for (const double x : edge) longest = std::max(longest, std::fabs(x));
  int power = 0;
  if (longest > 0.0) (void)std::frexp(longest, &power);
  local.scale = std::ldexp(1.0, -power);
  return local;
}

template <int D>
FoldoverFreeProblem<D> Untangler<D>::pose(const LocalProblem<D>& local) const {
  const ElementTable& elements = mesh_.input().mesh.elements;
  FoldoverFreeProblem<D> problem;
  problem.free_vertices = local.vertices.size();
  std::vector<Index> number(positions_.size(), kNoIndex);
  for (Index i = 0; i < local.vertices.size(); ++i) number[local.vertices[i]] = i;
  const auto offset = [&](Index v, Index from) {
    auto result = mesh_.in_frame(mesh_.difference(positions_[v], positions_[from]));
    for (double& x : result) x *= local.scale;
    return result;
  };
  for (const Index v : local.vertices) problem.places.push_back(offset(v, local.vertices[0]));
  const std::vector<Index> around = elements_of(local.vertices);
  problem.elements.reserve(around.size());
  for (const Index e : around) {
    typename FoldoverFreeProblem<D>::Element element{.kind = elements.kind(e)};
    const auto corners = elements.corners(e);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      element.vertices[k] = number[corners[k]];
      element.corners[k] = offset(corners[k], corners[0]);
    }
    problem.elements.push_back(element);
  }
  problem.size = size(around);
  for (int i = 0; i < D; ++i) problem.size *= local.scale;
  if (!(problem.size > 1e-30)) problem.size = 1.0;
  return problem;
}

/// Factor by which to scale an ideal element with edges of length 1, if all were alike and filled the elements' area or volume; it does not
/// depend on where the free vertices are.
template <int D>
double Untangler<D>::size(const std::vector<Index>& elements) const {
  const InputMesh& input = mesh_.input();
  double sum = 0.0, all = 0.0, ideal = 0.0;
  for (const Index e : elements) {
    double measure = 0.0;
    if constexpr (D == 2)
      measure = area(input, positions_, e);
    else
      measure = signed_volume(input.mesh.elements, positions_, e);
    sum += measure;
    all += std::fabs(measure);
    ideal += kIdealSizes[static_cast<std::size_t>(input.mesh.elements.kind(e))];
  }
  return (sum > 0.0 ? sum : all) / ideal;  // the elements may enclose less than nothing
}

/// Untangles a patch from its present positions, and from those to which springs take them: the latter first where most are inverted.
template <int D>
void Untangler<D>::untangle(const Patch& patch) {
  const QualityContext context = mesh_.input().quality_context();
  const std::vector<Index> elements = elements_of(patch);
  const auto inverted =
      std::ranges::count_if(elements, [&](Index e) { return smallest_jacobian(context, std::span<const Vec3>(positions_), e) <= 0.0; });
  const bool springs = static_cast<double>(inverted) > kMostlyInverted * static_cast<double>(elements.size());
  const std::size_t moves = moved_from_.size();
  if (untangle(patch, springs) > 0) (void)untangle(patch, !springs);
  if (moved_from_.size() > moves) vertices_.insert(vertices_.end(), patch.begin(), patch.end());
}

/// Returns how many elements that could be turned are left inverted.
template <int D>
Index Untangler<D>::untangle(const Patch& patch, bool springs_first) {
  const LocalProblem<D> local = local_problem(patch);
  FoldoverFreeProblem<D> problem = pose(local);
  for (int round = 0;; ++round) {
    std::unique_ptr<SlidingPath<D>> path;
    if (slides_) path = std::make_unique<SlidingPath<D>>(mesh_, local, positions_, *domain_, *limit_);
    problem.path = path && path->any() ? path.get() : nullptr;
    const FoldoverFreeSolution<D> solution = solve_foldover_free<D>(
        problem, {.springs_first = springs_first, .pool = options_.pool},
        [&](const FoldoverFreeIterate<D>& at) { show(local, at.displacements, at.steps, at.least); }, progress_);
    newton_steps_ += solution.steps;
    ++solutions_;
    const auto start = static_cast<Index>(solution.start_inverted);
    if (!(solution.inverted < solution.start_inverted)) return start;
    std::vector<Vec3> targets = targets_of(local, solution.best);
    if (problem.path != nullptr) (void)path->settle(1.0, local.free(), positions_, targets);
    if (keeps_sound_) {
      if (const std::vector<Index> lost = lost_by(local, targets); !lost.empty() && round < kMostRounds) {
        const std::vector<Index> around = elements_of(patch);
        for (std::size_t i = 0; i < around.size(); ++i)
          if (std::ranges::binary_search(lost, around[i])) problem.elements[i].weight *= kHeavier;
        continue;
      }
      spare(local, targets);
    }
    return move(local, targets) ? static_cast<Index>(solution.inverted) : start;
  }
}

/// Places of a patch's vertices after displacements.
template <int D>
std::vector<Vec3> Untangler<D>::targets_of(const LocalProblem<D>& local, const Offsets& displacements) const {
  std::vector<Vec3> targets;
  targets.reserve(displacements.size());
  for (std::size_t i = 0; i < displacements.size(); ++i)
    targets.push_back(mesh_.placed(positions_[local.vertices[i]], displacements[i], local.scale));
  return targets;
}

/// Elements that are sound now and inverted with a patch's vertices at their targets, ascending.
template <int D>
std::vector<Index> Untangler<D>::lost_by(const LocalProblem<D>& local, std::span<const Vec3> targets) const {
  const QualityContext context = mesh_.input().quality_context();
  std::vector<Vec3> there(positions_.begin(), positions_.end());
  for (std::size_t i = 0; i < targets.size(); ++i) there[local.vertices[i]] = targets[i];
  std::vector<Index> lost = mesh_.elements_at(local.free());
  std::erase_if(lost, [&](Index e) {
    return smallest_jacobian(context, std::span<const Vec3>(there), e) > 0.0 ||
           smallest_jacobian(context, std::span<const Vec3>(positions_), e) <= 0.0;
  });
  return lost;
}

/// Lets vertices stay until no element is inverted that is sound now.
template <int D>
void Untangler<D>::spare(const LocalProblem<D>& local, std::span<Vec3> targets) const {
  for (;;) {
    const std::vector<Index> lost = lost_by(local, targets);
    if (lost.empty()) return;
    for (const Index e : lost)
      for (const Index v : mesh_.input().mesh.elements.corners(e))
        if (const auto at = std::ranges::lower_bound(local.free(), v); at != local.free().end() && *at == v)
          targets[static_cast<std::size_t>(at - local.free().begin())] = positions_[v];
  }
}

/// Returns whether an element is inverted now that was sound when the call began.
template <int D>
bool Untangler<D>::loses_sound() const {
  const QualityContext context = mesh_.input().quality_context();
  std::vector<Vec3> begin(positions_.begin(), positions_.end());
  std::vector<Index> moved;
  for (auto move = moved_from_.rbegin(); move != moved_from_.rend(); ++move) {
    begin[move->first] = move->second;
    moved.push_back(move->first);
  }
  std::ranges::sort(moved);
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  return std::ranges::any_of(mesh_.elements_at(moved), [&](Index e) {
    return smallest_jacobian(context, std::span<const Vec3>(positions_), e) <= 0.0 &&
           smallest_jacobian(context, std::span<const Vec3>(begin), e) > 0.0;
  });
}

/// Moves the vertices if that is better by the program's own judgement.
template <int D>
bool Untangler<D>::move(const LocalProblem<D>& local, std::span<const Vec3> targets) {
  const JudgedMove move = mesh_.move_to(local, targets, positions_, metric_);
  const bool better = move.inverted_after < move.inverted_before && move.after >= move.before;
  for (std::size_t i = 0; i < move.moved_from.size(); ++i) {
    const Index v = local.vertices[i];
    if (better)
      moved_from_.emplace_back(v, move.moved_from[i]);
    else
      positions_[v] = move.moved_from[i];
  }
  if (!better) return false;
  before_ = std::min(before_, move.before);
  after_ = std::min(after_, move.after);
  return true;
}

template <int D>
void Untangler<D>::show(const LocalProblem<D>& local, const Offsets& displacements, int steps, double least) {
  if (!options_.on_step) return;
  options_.on_step({newton_steps_ + steps, least, 1.0, local.free(), targets_of(local, displacements)});
}

template <int D>
JointCluster Untangler<D>::told() const {
  JointCluster result;
  result.vertices = vertices_;
  std::ranges::sort(result.vertices);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  std::vector<std::uint8_t> is_known(positions_.size(), 0);  // whether the position at the start is known
  for (const auto& [vertex, from] : moved_from_) {
    if (is_known[vertex] == 0 && !same_bits(from, positions_[vertex])) result.moved.push_back({vertex, positions_[vertex]});
    is_known[vertex] = 1;
  }
  std::ranges::sort(result.moved, {}, &JointCluster::Moved::vertex);
  result.before = before_;
  result.after = result.bound = after_;
  result.why_not = "it untangles, and leaves the rest to what comes after";
  result.newton_steps = newton_steps_;
  result.solutions = solutions_;
  result.is_untangling = true;
  return result;
}

template class Untangler<2>;
template class Untangler<3>;

}  // namespace dmoscope
