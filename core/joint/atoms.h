#pragma once
// The smooth pieces of quality that joint moves work with: atoms.
//
// An element's quality is the least of its atoms', and each atom's is a smooth function of the D edges that leave its first vertex: a
// triangle or tetrahedron as a whole, each corner of any other element, and of a metric with kinks each corner or edge of a simplex
// that could be the one that counts.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// What an atom's edges are compared with: those of the ideal element there.
enum class AtomShape : std::uint8_t { Triangle, SquareCorner, Tetrahedron, CubeCorner, PrismCorner, PyramidCorner };
inline constexpr std::size_t kAtomShapeCount = 6;

/// `vertices`: in an order with the element's orientation; where a corner counts it is the first, where an edge does the first two.
template <int D>
struct Atom {
  std::array<Index, D + 1> vertices{};
  Index element = 0;
  AtomShape shape{};
};

/// Can the metric be split into atoms on all these kinds of elements? Empty: it can. Else a sentence that says why not.
[[nodiscard]] std::string joint_obstacle(Metric metric, KindSet kinds);
[[nodiscard]] inline bool joint_supports(Metric metric, KindSet kinds) { return joint_obstacle(metric, kinds).empty(); }

/// Appends the atoms of one element. The metric must be supported on its kind, whose dimension must be D.
template <int D>
void append_atoms(const ElementTable& elements, Metric metric, Index element, std::vector<Atom<D>>& atoms);

/// edges[j]: from the first vertex of an atom to vertex j + 1, in any unit of length.
template <int D>
using AtomEdges = std::array<std::array<double, D>, D>;

/// What of an atom is minimised. With J the determinant of its edges against the ideal ones and q its mean ratio, signed as J:
///   InverseQuality    1 / metric, +infinity where the metric is <= 0;
///   SignedPower       1 - q^(D / 2), smooth through J = 0, so that it leads out of a tangle;
///   RelativeJacobian  1 - J / reference, likewise.
enum class AtomMeasure : std::uint8_t { InverseQuality, SignedPower, RelativeJacobian };

/// Exact: the Hessian. Convex: a positive semidefinite one instead, with the determinant taken as linear (1 / mean ratio), without negative
/// eigenvalues (1 / any other metric), or 0 (what leads out of a tangle).
enum class Curvature : std::uint8_t { Exact, Convex };

/// By the D * D coordinates of the edges, edge by edge. By the atom's vertices: vertex j + 1 has the part of edge j, the first vertex the
/// negative sum of all.
template <int D>
struct AtomDerivatives {
  static constexpr std::size_t kCount = static_cast<std::size_t>(D) * D;
  double value = 0.0;
  std::array<double, kCount> gradient{};
  std::array<double, kCount * kCount> hessian{};  // row by row
};

/// The function to minimise, of atoms of any shape. The value at edges of any scale is the same, but of RelativeJacobian.
template <int D>
class AtomFunction {
 public:
  /// `metric`: must be defined in this dimension; of no account unless for InverseQuality.
  AtomFunction(Metric metric, AtomMeasure measure);
  /// `reference`: > 0, for RelativeJacobian alone, in the unit of the edges to the power of D.
  [[nodiscard]] double value(AtomShape shape, const AtomEdges<D>& edges, double reference) const {
    return value_[static_cast<std::size_t>(shape)](shape, edges, reference);
  }
  /// Where the value is finite.
  void derive(AtomShape shape, const AtomEdges<D>& edges, double reference, Curvature curvature, AtomDerivatives<D>& result) const {
    derive_[static_cast<std::size_t>(shape)](shape, edges, reference, curvature, result);
  }
  /// Whether the Hessian's diagonal says how stiff a vertex is: it never vanishes where the function is convex in each single vertex.
  [[nodiscard]] bool convex_by_vertex() const noexcept { return convex_by_vertex_; }

 private:
  using Value = double (*)(AtomShape, const AtomEdges<D>&, double);
  using Derive = void (*)(AtomShape, const AtomEdges<D>&, double, Curvature, AtomDerivatives<D>&);
  std::array<Value, kAtomShapeCount> value_{};
  std::array<Derive, kAtomShapeCount> derive_{};
  bool convex_by_vertex_ = false;
};

/// The determinant of an atom's edges against the ideal ones; positive where the atom is not inverted.
template <int D>
[[nodiscard]] double atom_jacobian(AtomShape shape, const AtomEdges<D>& edges);

}  // namespace dmoscope
