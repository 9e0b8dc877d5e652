#include "core/joint/untangler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/same_bits.h"
#include "core/joint/foldover_free.h"
#include "core/mesh/volume.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kInteriorPointSteps = 30;  // what leads out does so soon
constexpr double kEnough = 0.95;         // an f: far enough from inverted

/// What an element with edges of length 1 measures, by kind.
constexpr std::array<double, kElementKindCount> kIdealSizes{0.4330127018922193, 1.0, 0.11785113019775793, 1.0, 0.4330127018922193,
                                                            0.23570226039551587};

/// Of a planar element, counter-clockwise.
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
Untangler<D>::Untangler(const JointMesh<D>& mesh, Metric metric, std::span<Vec3> positions, JointState& state, const JointOptions& options,
                        Progress& progress)
    : mesh_(mesh),
      metric_(metric),
      positions_(positions),
      state_(state),
      options_(options),
      progress_(progress),
      most_together_(options.whole_at_most > 0 ? options.whole_at_most
                     : D == 2                  ? 20000
                                               : 3000),
      before_(kInfinity),
      after_(kInfinity) {}

template <int D>
Untangler<D>::~Untangler() {
  if (finished_) return;
  for (auto move = moved_from_.rbegin(); move != moved_from_.rend(); ++move) positions_[move->first] = move->second;
}

template <int D>
std::optional<JointCluster> Untangler<D>::run() {
  std::vector<Index> inverted;
  if (state_.untanglings < kMostAttempts) inverted = inverted_elements();
  if (!inverted.empty()) attempt_all(inverted);
  finished_ = true;
  if (moved_from_.empty()) return std::nullopt;
  state_.atoms.clear();  // what is known of elements is of before
  state_.levels.clear();
  state_.pushed = state_.beyond = false;
  state_.end = JointState::End::None;
  ++state_.clusters;
  return told();
}

/// One attempt after another, from where the last call ended, until one helps; where none does that is the end of it.
template <int D>
void Untangler<D>::attempt_all(const std::vector<Index>& inverted) {
  std::uint32_t& next = state_.untanglings;
  std::vector<std::vector<Index>> groups;
  int rings = 0;
  bool same = false;  // as with fewer rings: they were tried in this call
  for (std::size_t tried = 0; tried < kAttempts.size(); ++tried) {
    if (next == kMostAttempts) return;
    const Attempt& attempt = kAttempts[next++ % kAttempts.size()];
    if (options_.only_untangle && attempt.rings == kWhole) return;
    if (attempt.rings != rings) {
      std::vector<std::vector<Index>> others = patches(inverted, attempt.rings);
      same = attempt.rings > rings && others == groups;
      groups = std::move(others);
      rings = attempt.rings;
    }
    if (same) continue;
    for (const std::vector<Index>& patch : groups)
      if (untangle(patch, attempt.way)) vertices_.insert(vertices_.end(), patch.begin(), patch.end());
    if (!moved_from_.empty()) return;
  }
  next = kMostAttempts;
}

/// Those that could be turned: the corners at fault have free vertices, or none is and it is inverted inside.
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

/// How many rings a free vertex is away from the inverted elements, up to `most`; kFar beyond that, and for others.
template <int D>
std::vector<int> Untangler<D>::rings_from(const std::vector<Index>& inverted, int most) const {
  const Mesh& mesh = mesh_.input().mesh;
  std::vector<std::uint8_t> movable(positions_.size(), 0);
  for (const Index v : mesh_.free_vertices()) movable[v] = 1;
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

/// Of those among `vertices` that are up to so many rings away the connected patches, in pieces of at most `most` vertices; each ascending.
template <int D>
std::vector<std::vector<Index>> Untangler<D>::connected(std::span<const Index> vertices, const std::vector<int>& rings, int limit,
                                                        std::size_t most) const {
  std::vector<std::uint8_t> open(positions_.size(), 0);
  for (const Index v : vertices) open[v] = rings[v] <= limit ? 1 : 0;
  std::vector<std::vector<Index>> result;
  for (const Index first : vertices) {
    if (open[first] == 0) continue;
    std::vector<Index> patch{first};
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

/// Free vertices within so many rings of the inverted elements, by connected patches. Those that are too large have fewer rings, and at
/// last are cut.
template <int D>
std::vector<std::vector<Index>> Untangler<D>::patches(const std::vector<Index>& inverted, int most) const {
  const std::vector<int> rings = rings_from(inverted, most);
  int limit = 0;
  for (const int ring : rings)
    if (ring != kFar) limit = std::max(limit, ring);
  std::vector<std::vector<Index>> result, large{{mesh_.free_vertices().begin(), mesh_.free_vertices().end()}};
  for (bool is_last = false; !large.empty() && !is_last; limit /= 2) {
    is_last = limit == 0;
    std::vector<std::vector<Index>> next;
    for (const std::vector<Index>& one : large)
      for (std::vector<Index>& patch : connected(one, rings, limit, is_last ? most_together_ : one.size()))
        (patch.size() <= most_together_ ? result : next).push_back(std::move(patch));
    large = std::move(next);
  }
  return result;
}

/// The determinant of atoms that are all alike, if their elements filled what these do; that does not depend on where the free vertices
/// are.
template <int D>
double Untangler<D>::reference(const LocalProblem<D>& local) const {
  const InputMesh& input = mesh_.input();
  double sum = 0.0, ideal = 0.0;
  for (const Index e : mesh_.elements_at(local.free())) {
    if constexpr (D == 2)
      sum += area(input, positions_, e);
    else
      sum += signed_volume(input.mesh.elements, positions_, e);
    ideal += kIdealSizes[static_cast<std::size_t>(input.mesh.elements.kind(e))];
  }
  double mean = ideal > 0.0 ? sum / ideal : 0.0;
  for (int i = 0; i < D; ++i) mean *= local.scale;
  if (mean > 1e-30) return mean;
  // They enclose less than nothing.
  double jacobians = 0.0;
  for (std::size_t a = 0; a < local.problem.atoms.size(); ++a)
    jacobians += std::fabs(atom_jacobian<D>(local.problem.atoms[a].shape, local.problem.edges[a]));
  mean = jacobians / static_cast<double>(local.problem.atoms.size());
  return mean > 1e-30 ? mean : 1.0;
}

template <int D>
bool Untangler<D>::untangle(const std::vector<Index>& patch, Way way) {
  LocalProblem<D> local = mesh_.problem(patch, positions_);
  local.problem.references.assign(local.problem.atoms.size(), reference(local));
  const Offsets displacements = way == Way::SignedPower ? by_interior_point(local) : by_foldover_free(local, way == Way::Sprung);
  ++solutions_;
  if (displacements.empty()) return false;
  const JudgedMove move = mesh_.move(local, displacements, positions_, metric_);
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

/// Empty: it leads nowhere.
template <int D>
typename Untangler<D>::Offsets Untangler<D>::by_interior_point(const LocalProblem<D>& local) {
  JointCallbacks<D> callbacks;
  callbacks.step = [&](const JointIterate<D>& at) { show(local, at.displacements, at.steps, 1.0 - at.worst); };
  JointSolution<D> solution =
      solve_joint<D>(local.problem, AtomFunction<D>(Metric::MeanRatio, AtomMeasure::SignedPower),
                     {.enough = kEnough, .max_steps = kInteriorPointSteps, .pool = options_.pool}, callbacks, progress_);
  newton_steps_ += solution.last.steps;
  if (!(solution.best_worst < solution.start_worst)) return {};
  return std::move(solution.best);
}

template <int D>
typename Untangler<D>::Offsets Untangler<D>::by_foldover_free(const LocalProblem<D>& local, bool sprung) {
  Offsets start(local.problem.free_vertices);
  if (sprung) start = sprung_displacements<D>(local.problem);
  FoldoverFreeSolution<D> solution = solve_foldover_free<D>(
      local.problem, std::move(start), {}, [&](const FoldoverFreeIterate<D>& at) { show(local, at.displacements, at.steps, at.least); },
      progress_);
  newton_steps_ += solution.steps;
  const bool only_inside = solution.start_inverted == 0 && solution.least > solution.start_least;  // what corners do not tell
  if (!(solution.inverted < solution.start_inverted) && !only_inside) return {};
  return std::move(solution.best);
}

template <int D>
void Untangler<D>::show(const LocalProblem<D>& local, const Offsets& displacements, int steps, double least) {
  if (!options_.on_step) return;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < displacements.size(); ++i)
    places.push_back(mesh_.placed(positions_[local.vertices[i]], displacements[i], local.scale));
  options_.on_step({newton_steps_ + steps, least, 1.0, local.free(), places});
}

template <int D>
JointCluster Untangler<D>::told() const {
  JointCluster result;
  result.vertices = vertices_;
  std::ranges::sort(result.vertices);
  for (const auto& [vertex, from] : moved_from_)
    if (!same_bits(from, positions_[vertex])) result.moved.push_back({vertex, positions_[vertex]});
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
