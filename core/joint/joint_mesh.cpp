#include "core/joint/joint_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/joint/defined_atoms.h"
#include "core/quality/quality.h"
#include "core/smooth/displace.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Frame of a mesh whose elements' dimension is D.
template <int D>
auto frame_of(const Geometry& geometry) {
  if constexpr (D == 2)
    return geometry.plane;
  else
    return Space{};
}

template <int D>
AtomFunction<D> function_of(const InputMesh& input, Metric metric) {
  if constexpr (D == 3)
    if (input.is_surface() && is_built_in(metric)) return {metric, input.view<Curved>().frame};
  if (is_built_in(metric)) return AtomFunction<D>(metric);
  return AtomFunction<D>(std::make_shared<const DefinedAtoms<D>>(input, metric));
}

void sort_unique(std::vector<Index>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

template <int D>
JointMesh<D>::JointMesh(const InputMesh& input, Metric metric, std::span<const std::uint8_t> fixed)
    : input_(&input), metric_(metric), function_(function_of<D>(input, metric)) {
  const ElementTable& elements = input.mesh.elements;
  const auto is_fixed = [fixed](Index v) { return fixed[v] != 0; };
  std::vector<Atom<D>> of_element;
  for (Index e = 0; e < elements.size(); ++e) {
    if (info(elements.kind(e)).dimension != (input.is_surface() ? 2 : D) || std::ranges::all_of(elements.corners(e), is_fixed)) continue;
    of_element.clear();
    if (function_.defined() != nullptr)
      function_.defined()->append(elements, e, of_element);
    else
      append_atoms<D>(elements, metric, e, of_element);
    for (const Atom<D>& atom : of_element) (std::ranges::all_of(atom.vertices, is_fixed) ? held_ : atoms_).push_back(atom);
  }
  const std::size_t vertices = input.mesh.vertex_count();
  star_offsets_.assign(vertices + 1, 0);
  for (const Atom<D>& atom : atoms_)
    for (const Index v : atom.vertices) ++star_offsets_[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) star_offsets_[v + 1] += star_offsets_[v];
  star_.resize(star_offsets_.back());
  std::vector<Index> filled(star_offsets_.begin(), star_offsets_.end() - 1);
  for (Index a = 0; a < atoms_.size(); ++a)
    for (const Index v : atoms_[a].vertices) star_[filled[v]++] = a;
  for (Index v = 0; v < vertices; ++v)
    if (fixed[v] == 0 && !atoms_at(v).empty()) free_.push_back(v);
}

template <int D>
AtomEdges<D> JointMesh<D>::edges(const Atom<D>& atom, std::span<const Vec3> positions) const {
  const auto frame = frame_of<D>(input_->geometry);
  AtomEdges<D> result{};
  for (std::size_t j = 0; j < D; ++j) {
    const auto e = frame.offset(positions[atom.vertices[j + 1]], positions[atom.vertices[0]]);
    result[j][0] = e.x;
    result[j][1] = e.y;
    if constexpr (D == 3) result[j][2] = e.z;
  }
  return result;
}

template <int D>
std::vector<double> JointMesh<D>::qualities(std::span<const Vec3> positions) const {
  const auto quality = [&](const Atom<D>& atom) {
    const AtomEdges<D> at = edges(atom, positions);
    if (atom.piece == kGuardPiece) return function_.defined()->jacobian(atom, at) > 0.0 ? kInfinity : 0.0;
    return 1.0 / function_.value(atom, at, 1.0);
  };
  std::vector<double> result;
  result.reserve(atoms_.size());
  for (const Atom<D>& atom : atoms_) result.push_back(quality(atom));
  // Walks both lists at once, which go by elements.
  auto held = held_.begin();
  double of_element = kInfinity;
  for (std::size_t a = 0; a < atoms_.size(); ++a) {
    const Index element = atoms_[a].element;
    if (a == 0 || atoms_[a - 1].element != element) {
      of_element = kInfinity;
      for (; held != held_.end() && held->element <= element; ++held)
        if (held->element == element) of_element = std::min(of_element, quality(*held));
    }
    if (result[a] > 0.0 && result[a] >= of_element) result[a] = kInfinity;
  }
  return result;
}

/// Atoms with one of the vertices, ascending.
template <int D>
std::vector<Index> JointMesh<D>::atoms_at(std::span<const Index> vertices) const {
  std::vector<Index> atoms;
  for (const Index v : vertices) atoms.insert(atoms.end(), atoms_at(v).begin(), atoms_at(v).end());
  sort_unique(atoms);
  return atoms;
}

/// Gives a problem more atoms, with edges in mesh units; returns the longest of their coordinates.
template <int D>
double JointMesh<D>::add_atoms(LocalProblem<D>& local, std::span<const Index> atoms, std::span<const Vec3> positions) const {
  std::vector<Index> number(input_->mesh.vertex_count(), kNoIndex);
  for (std::size_t i = 0; i < local.vertices.size(); ++i) number[local.vertices[i]] = static_cast<Index>(i);
  double longest = 0.0;
  for (const Index a : atoms) {
    Atom<D> atom = atoms_[a];
    local.problem.edges.push_back(edges(atom, positions));
    for (const auto& edge : local.problem.edges.back())
      for (const double x : edge) longest = std::max(longest, std::fabs(x));
    for (Index& v : atom.vertices) {
      if (number[v] == kNoIndex) {
        number[v] = static_cast<Index>(local.vertices.size());
        local.vertices.push_back(v);
      }
      v = number[v];
    }
    if (atom.shape == AtomShape::SurfaceTriangle) atom.vertices.back() = kNoIndex;
    local.problem.atoms.push_back(atom);
  }
  return longest;
}

/// Brings the last atoms' edges into the problem's unit, and sets all else that the problem knows of them and their vertices.
template <int D>
void JointMesh<D>::settle_atoms(LocalProblem<D>& local, std::size_t count, std::span<const Vec3> positions) const {
  JointProblem<D>& problem = local.problem;
  for (std::size_t a = problem.edges.size() - count; a < problem.edges.size(); ++a)
    for (auto& edge : problem.edges[a])
      for (double& x : edge) x *= local.scale;
  if (function_.defined() != nullptr || !problem.references.empty()) set_references(local, count);
  const auto frame = frame_of<D>(input_->geometry);
  for (std::size_t i = problem.places.size(); i < local.vertices.size(); ++i) {
    const auto from_first = frame.offset(positions[local.vertices[i]], positions[local.vertices[0]]);
    if constexpr (D == 2)
      problem.places.push_back({from_first.x, from_first.y});
    else
      problem.places.push_back({from_first.x, from_first.y, from_first.z});
  }
}

template <int D>
LocalProblem<D> JointMesh<D>::problem(std::span<const Index> free, std::span<const Vec3> positions) const {
  LocalProblem<D> local;
  local.problem.free_vertices = free.size();
  local.vertices.assign(free.begin(), free.end());
  local.atoms = atoms_at(free);
  const double longest = add_atoms(local, local.atoms, positions);
  if (longest > 0.0) {
    int power = 0;
    (void)std::frexp(longest, &power);
    local.scale = std::ldexp(1.0, -power);
  }
  settle_atoms(local, local.atoms.size(), positions);
  return local;
}

template <int D>
void JointMesh<D>::limit(LocalProblem<D>& local, double quality, std::span<const Vec3> positions) const {
  constexpr double kRoom = 1e-9;  // relative room for atoms that rounding puts beyond their limit
  JointProblem<D>& problem = local.problem;
  local.limited = atoms_at(local.free());
  (void)add_atoms(local, local.limited, positions);
  settle_atoms(local, local.limited.size(), positions);
  problem.limited = &function_;
  const std::size_t raised = problem.atoms.size() - local.limited.size();
  for (std::size_t a = raised; a < problem.atoms.size(); ++a)
    problem.limits.push_back(
        std::max(function_.inverse_of(quality), (1.0 + kRoom) * function_.value(problem.atoms[a], problem.edges[a], problem.reference(a))));
}

/// Sets the references of the last atoms, see DefinedAtoms: the scale, and for guards their mean ratio in units of the worst atom's.
template <int D>
void JointMesh<D>::set_references(LocalProblem<D>& local, std::size_t count) const {
  JointProblem<D>& problem = local.problem;
  problem.references.resize(problem.atoms.size(), local.scale);
  const std::size_t first = problem.atoms.size() - count;
  double worst = 0.0;
  for (std::size_t a = first; a < problem.atoms.size(); ++a)
    if (problem.atoms[a].piece != kGuardPiece) worst = std::max(worst, function_.value(problem.atoms[a], problem.edges[a], local.scale));
  for (std::size_t a = first; a < problem.atoms.size(); ++a)
    if (problem.atoms[a].piece == kGuardPiece)
      problem.references[a] = worst / function_.defined()->guard(problem.atoms[a], problem.edges[a]);
}

template <int D>
typename JointMesh<D>::Offset JointMesh<D>::in_frame(Vec3 way) const {
  const auto offset = frame_of<D>(input_->geometry).project(way);
  if constexpr (D == 2)
    return {offset.x, offset.y};
  else
    return {offset.x, offset.y, offset.z};
}

template <int D>
Vec3 JointMesh<D>::lifted(const Offset& offset) const {
  if constexpr (D == 2)
    return input_->geometry.plane.lift({offset[0], offset[1]});
  else
    return {offset[0], offset[1], offset[2]};
}

template <int D>
Vec3 JointMesh<D>::placed(Vec3 position, const Offset& displacement, double scale) const {
  const bool single = input_->mesh.single_precision;
  const Vec3 by = (1.0 / scale) * lifted(displacement);
  Vec3 result{displaced(position.x, by.x, single), displaced(position.y, by.y, single), displaced(position.z, by.z, single)};
  const Plane& plane = input_->geometry.plane;
  if (D == 2 && plane.period > 0.0) result.x = settled(result.x, plane.west, plane.period, single);
  return result;
}

template <int D>
std::vector<Index> JointMesh<D>::elements_at(std::span<const Index> vertices) const {
  std::vector<Index> elements;
  for (const Index v : vertices)
    for (const Incidence& incidence : input_->topology.star(v)) elements.push_back(incidence.element);
  sort_unique(elements);
  return elements;
}

template <int D>
JudgedMove JointMesh<D>::move(const LocalProblem<D>& local, std::span<const Offset> displacements, std::span<Vec3> positions,
                              Metric metric) const {
  std::vector<Vec3> targets;
  targets.reserve(displacements.size());
  for (std::size_t i = 0; i < displacements.size(); ++i)
    targets.push_back(placed(positions[local.vertices[i]], displacements[i], local.scale));
  return move_to(local, targets, positions, metric);
}

template <int D>
JudgedMove JointMesh<D>::move_to(const LocalProblem<D>& local, std::span<const Vec3> targets, std::span<Vec3> positions,
                                 Metric metric) const {
  const QualityContext context = input_->quality_context();
  const std::vector<Index> elements = elements_at(local.free());
  JudgedMove move;
  std::vector<double> before;
  before.reserve(elements.size());
  for (const Index e : elements) {
    before.push_back(element_quality(context, positions, metric, e));
    move.inverted_before += smallest_jacobian(context, positions, e) <= 0.0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Vec3& position = positions[local.vertices[i]];
    move.moved_from.push_back(position);
    position = targets[i];
  }
  move.before = move.after = kInfinity;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double after = element_quality(context, positions, metric, elements[i]);
    move.inverted_after += smallest_jacobian(context, positions, elements[i]) <= 0.0 ? 1 : 0;
    if (after == before[i]) continue;
    move.before = std::min(move.before, before[i]);
    move.after = std::min(move.after, after);
  }
  return move;
}

template class JointMesh<2>;
template class JointMesh<3>;

}  // namespace dmoscope
