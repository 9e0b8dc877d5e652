#pragma once
// Atoms: the smooth pieces of quality that joint moves work with.
//
// An element's quality is the least of its atoms', and each atom's is a smooth function of the D edges that leave its first vertex: a
// triangle or tetrahedron as a whole, each corner of any other element, and for a metric with kinks each corner or edge of a simplex that
// may be its least. Formulas and targets name their pieces themselves (DefinedAtoms).

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/corner_tables.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// Ideal element whose edges those of an atom are compared with. The last two belong to curved surfaces, in space.
enum class AtomShape : std::uint8_t {
  Triangle,
  SquareCorner,
  Tetrahedron,
  CubeCorner,
  PrismCorner,
  PyramidCorner,
  SurfaceTriangle,
  SurfaceSquareCorner
};
inline constexpr std::size_t kAtomShapeCount = 8;
[[nodiscard]] constexpr bool is_on_surface(AtomShape shape) { return shape >= AtomShape::SurfaceTriangle; }
[[nodiscard]] constexpr AtomShape surface_shape(ElementKind kind) {
  return kind == ElementKind::Triangle ? AtomShape::SurfaceTriangle : AtomShape::SurfaceSquareCorner;
}
[[nodiscard]] constexpr ElementKind kind_of(AtomShape shape) {
  if (!is_on_surface(shape)) return static_cast<ElementKind>(shape);
  return shape == AtomShape::SurfaceTriangle ? ElementKind::Triangle : ElementKind::Quadrilateral;
}

/// Atom of an element. `vertices`: in an order with the element's orientation; an atom at a corner begins with that, an atom at an edge
/// with its two ends. On a curved surface a quadrilateral's opposite corner is the last, which its plane depends on; a triangle has no
/// other, and repeats its first vertex.
template <int D>
struct Atom {
  std::array<Index, D + 1> vertices{};
  Index element = 0;
  AtomShape shape{};
  std::uint8_t frame = 0;   // row of corner_frames() that the vertices are; for a metric that is defined by a formula or a target
  std::uint16_t piece = 0;  // which of such a metric's pieces it is, or kGuardPiece
};

/// Corners of a kind that have an edge for each dimension, each with the ends of its edges, right-handed; a simplex has one for all.
[[nodiscard]] std::span<const CornerTable> corner_frames(ElementKind kind);

/// Reason why the metric cannot be split into atoms on all these kinds of elements, one sentence; empty where it can.
[[nodiscard]] std::string joint_obstacle(Metric metric, KindSet kinds);
[[nodiscard]] inline bool joint_supports(Metric metric, KindSet kinds) { return joint_obstacle(metric, kinds).empty(); }

/// Appends the atoms of one element. The metric must be built in and supported on its kind, whose dimension must be D, or 2 in a curved
/// surface, where D is 3.
template <int D>
void append_atoms(const ElementTable& elements, Metric metric, Index element, std::vector<Atom<D>>& atoms);

/// Edges of an atom: edges[j] leads from its first vertex to vertex j + 1, in any unit of length.
template <int D>
using AtomEdges = std::array<std::array<double, D>, D>;

/// Kind of Hessian. Exact: the true one. Convex: a positive semidefinite one instead, with the determinant taken as linear (1 / mean
/// ratio), or without negative eigenvalues (1 / any other metric).
enum class Curvature : std::uint8_t { Exact, Convex };

/// Derivatives by the D * D coordinates of the edges, edge by edge. By the atom's vertices: vertex j + 1 has the part of edge j, the first
/// vertex the negative sum of all.
template <int D>
struct AtomDerivatives {
  static constexpr std::size_t kCount = static_cast<std::size_t>(D) * D;
  double value = 0.0;
  std::array<double, kCount> gradient{};
  std::array<double, kCount * kCount> hessian{};  // row by row
};

template <int D>
class DefinedAtoms;

/// Function of an atom that is minimised: 1 / metric, +infinity where that is <= 0. It does not depend on the scale of the edges, unless a
/// formula or target defines the metric.
template <int D>
class AtomFunction {
 public:
  /// Takes a built-in metric that is defined in this dimension.
  explicit AtomFunction(Metric metric);
  /// Takes a built-in metric on a curved surface; D is 3.
  AtomFunction(Metric metric, const Curved& frame);
  /// Takes a metric that is defined by a formula or a target.
  explicit AtomFunction(std::shared_ptr<const DefinedAtoms<D>> atoms);
  /// Value at these edges. `reference`: see DefinedAtoms; without these ignored.
  [[nodiscard]] double value(const Atom<D>& atom, const AtomEdges<D>& edges, double reference) const {
    if (defined_) return defined_value(atom, edges, reference);
    if (surface_.value != nullptr) return surface_.value(atom.shape, edges, surface_.frame.of(atom.element));
    return value_[static_cast<std::size_t>(atom.shape)](atom.shape, edges, reference);
  }
  /// Derivatives where the value is finite.
  void derive(const Atom<D>& atom, const AtomEdges<D>& edges, double reference, Curvature curvature, AtomDerivatives<D>& result) const {
    if (defined_) return derive_defined(atom, edges, reference, curvature, result);
    if (surface_.value != nullptr) return surface_.derive(atom.shape, edges, surface_.frame.of(atom.element), curvature, result);
    derive_[static_cast<std::size_t>(atom.shape)](atom.shape, edges, reference, curvature, result);
  }
  /// Quality at which the value is f.
  [[nodiscard]] double quality_of(double f) const noexcept { return 1.0 / f - shift(); }
  [[nodiscard]] double inverse_of(double quality) const noexcept { return 1.0 / (quality + shift()); }
  [[nodiscard]] const DefinedAtoms<D>* defined() const noexcept { return defined_.get(); }
  /// Returns whether the Hessian's diagonal says how stiff a vertex is: it never vanishes where the function is convex in each single
  /// vertex.
  [[nodiscard]] bool convex_by_vertex() const noexcept { return convex_by_vertex_; }

 private:
  using Value = double (*)(AtomShape, const AtomEdges<D>&, double);
  using Derive = void (*)(AtomShape, const AtomEdges<D>&, double, Curvature, AtomDerivatives<D>&);
  [[nodiscard]] double defined_value(const Atom<D>& atom, const AtomEdges<D>& edges, double reference) const;
  void derive_defined(const Atom<D>& atom, const AtomEdges<D>& edges, double reference, Curvature curvature,
                      AtomDerivatives<D>& result) const;
  [[nodiscard]] double shift() const noexcept;
  struct OnSurface {
    double (*value)(AtomShape, const AtomEdges<D>&, const Curved&) = nullptr;
    void (*derive)(AtomShape, const AtomEdges<D>&, const Curved&, Curvature, AtomDerivatives<D>&) = nullptr;
    Curved frame{};
  };
  OnSurface surface_{};  // derivation of a built-in metric on a curved surface
  std::array<Value, kAtomShapeCount> value_{};
  std::array<Derive, kAtomShapeCount> derive_{};
  std::shared_ptr<const DefinedAtoms<D>> defined_;  // null: the metric is built in
  bool convex_by_vertex_ = false;
};

/// Determinant of an atom's edges against the ideal ones; positive where the atom is not inverted.
template <int D>
[[nodiscard]] double atom_jacobian(AtomShape shape, const AtomEdges<D>& edges);

}  // namespace dmoscope
