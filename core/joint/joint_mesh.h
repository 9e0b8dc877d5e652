#pragma once
// Mesh as joint moves see it: its atoms, their adjacency, and problems over some of its vertices.

#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/joint/interior_point.h"

namespace dmoscope {

/// Problem over some vertices of a mesh.
template <int D>
struct LocalProblem {
  JointProblem<D> problem;
  std::vector<Index> vertices;  // vertex of the mesh for each of the problem's, first those that may move, ascending
  std::vector<Index> atoms;     // atom of the mesh for each raised one of the problem's, ascending
  std::vector<Index> limited;   // atom for each of those with limits, ascending, in the JointMesh whose limits they are
  double scale = 1.0;           // length of a mesh unit in the unit of the problem: a power of two
  [[nodiscard]] std::span<const Index> free() const { return std::span(vertices).first(problem.free_vertices); }
};

/// Effect of a move on the elements at its vertices, judged by the program's own metric in double.
struct JudgedMove {
  std::vector<Vec3> moved_from;                   // positions of the problem's free vertices before
  double before = 0.0, after = 0.0;               // least quality of the elements that it changed; both +infinity where it changed none
  Index inverted_before = 0, inverted_after = 0;  // inverted ones of all elements at its vertices
};

/// Atoms of a mesh. Immutable but for its work space; one thread at a time. Elements all of whose vertices are fixed are left out.
template <int D>
class JointMesh {
 public:
  using Offset = std::array<double, static_cast<std::size_t>(D)>;
  /// `metric`: see joint_obstacle. `fixed`: one entry a vertex, non-zero where it may not move. The input must outlive it.
  JointMesh(const InputMesh& input, Metric metric, std::span<const std::uint8_t> fixed);

  /// Atoms with a free vertex.
  [[nodiscard]] std::span<const Atom<D>> atoms() const noexcept { return atoms_; }
  /// Atoms at a vertex, ascending.
  [[nodiscard]] std::span<const Index> atoms_at(Index vertex) const {
    return {star_.data() + star_offsets_[vertex], star_.data() + star_offsets_[vertex + 1]};
  }
  /// Free vertices of elements that are not left out, ascending.
  [[nodiscard]] std::span<const Index> free_vertices() const noexcept { return free_; }
  [[nodiscard]] const InputMesh& input() const noexcept { return *input_; }
  [[nodiscard]] Metric metric() const noexcept { return metric_; }
  /// Function of the atoms: 1 / metric.
  [[nodiscard]] const AtomFunction<D>& function() const noexcept { return function_; }

  /// Edges of an atom at these positions.
  [[nodiscard]] AtomEdges<D> edges(const Atom<D>& atom, std::span<const Vec3> positions) const;
  /// 1 / f of every atom, by function(); 0 where it is not positive; +infinity where a part of its element that cannot move is no better,
  /// and of guards.
  [[nodiscard]] std::vector<double> qualities(std::span<const Vec3> positions) const;
  /// Gives a problem of a JointMesh of another metric the atoms at its free vertices, whose qualities stay above this one where they are.
  void limit(LocalProblem<D>& local, double quality, std::span<const Vec3> positions) const;
  /// Problem over the vertices `free`, ascending. All other vertices stay.
  [[nodiscard]] LocalProblem<D> problem(std::span<const Index> free, std::span<const Vec3> positions) const;
  /// Position of a vertex after a displacement by the problem.
  [[nodiscard]] Vec3 placed(Vec3 position, const Offset& displacement, double scale) const;
  /// Displacement in space as one of the problem, in mesh units.
  [[nodiscard]] Offset in_frame(Vec3 way) const;
  /// Shortest way from `origin` to `at`.
  [[nodiscard]] Vec3 difference(Vec3 at, Vec3 origin) const { return input_->geometry.plane.difference(at, origin); }
  /// Direction of the problem in space.
  [[nodiscard]] Vec3 lifted(const Offset& offset) const;
  /// Elements with one of the vertices, ascending.
  [[nodiscard]] std::vector<Index> elements_at(std::span<const Index> vertices) const;
  /// Moves the free vertices and judges the move. It may be undone by moved_from.
  JudgedMove move(const LocalProblem<D>& local, std::span<const Offset> displacements, std::span<Vec3> positions) const {
    return move(local, displacements, positions, metric_);
  }
  /// Judges the move by another metric.
  JudgedMove move(const LocalProblem<D>& local, std::span<const Offset> displacements, std::span<Vec3> positions, Metric metric) const;
  /// Moves the free vertices to `targets`, one each.
  JudgedMove move_to(const LocalProblem<D>& local, std::span<const Vec3> targets, std::span<Vec3> positions, Metric metric) const;

 private:
  [[nodiscard]] std::vector<Index> atoms_at(std::span<const Index> vertices) const;
  double add_atoms(LocalProblem<D>& local, std::span<const Index> atoms, std::span<const Vec3> positions) const;
  void settle_atoms(LocalProblem<D>& local, std::size_t count, std::span<const Vec3> positions) const;
  void set_references(LocalProblem<D>& local, std::size_t count) const;

  const InputMesh* input_;
  Metric metric_;
  AtomFunction<D> function_;
  std::vector<Atom<D>> atoms_, held_;  // held: those of elements not left out all of whose vertices are fixed
  std::vector<Index> star_offsets_, star_, free_;
};

}  // namespace dmoscope
