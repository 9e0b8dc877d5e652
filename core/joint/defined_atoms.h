#pragma once
// Atoms of a metric that is defined by a formula or a target: its smooth pieces, run on numbers that carry derivatives.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/joint/atoms.h"
#include "core/quality/defined_judge.h"

namespace dmoscope {

/// Piece of a guard, which is not of the metric: it keeps the vertices from inverting where the metric does not see that.
inline constexpr std::uint16_t kGuardPiece = 0xffff;

/// Pieces of a defined metric on a mesh. Immutable. The mesh must outlive it.
template <int D>
class DefinedAtoms {
 public:
  /// `metric`: see joint_obstacle(). 1 / (quality + shift) is minimised, with a shift that makes the quality of every sound element of the
  /// input positive: 0 where it is.
  DefinedAtoms(const InputMesh& input, Metric metric);

  /// Appends the atoms of one element, whose dimension must be D, or 2 in a curved surface, where D is 3.
  void append(const ElementTable& elements, Index element, std::vector<Atom<D>>& atoms) const;
  [[nodiscard]] double shift() const noexcept { return shift_; }

  /// Value of a guard: 1 / mean ratio.
  [[nodiscard]] double guard(const Atom<D>& atom, const AtomEdges<D>& edges) const;
  /// See atom_jacobian().
  [[nodiscard]] double jacobian(const Atom<D>& atom, const AtomEdges<D>& edges) const;

  /// See AtomFunction. `reference`: the edges' length over that in the mesh; for a guard its value at the begin, at a thousandth: the
  /// metric's greatest f over its own guard().
  [[nodiscard]] double value(const Atom<D>& atom, const AtomEdges<D>& edges, double reference) const;
  void derive(const Atom<D>& atom, const AtomEdges<D>& edges, double reference, Curvature curvature, AtomDerivatives<D>& result) const;

 private:
  /// Pieces of the metric in elements of one kind, in one space.
  struct OfKind {
    std::span<const FormulaPiece> pieces;
    std::vector<std::uint8_t> frames;   // by piece, the corner that its atom is at
    std::vector<std::uint8_t> guarded;  // corners that have an atom of their own
  };
  [[nodiscard]] const OfKind& of(ElementKind kind, FormulaSpace space) const {
    return kinds_[static_cast<std::size_t>(space) * kElementKindCount + static_cast<std::size_t>(kind)];
  }
  void find_pieces(ElementKind kind, FormulaSpace space);
  /// Quality + shift in any scalar. variable(x, i): the i-th of the edges' coordinates.
  template <class R, class Variable>
  [[nodiscard]] R quality(const Atom<D>& atom, const AtomEdges<D>& edges, const Variable& variable) const;

  const InputMesh* input_;
  int dimension_;  // dimension of the elements
  Curved frame_;   // frame on a curved surface
  std::shared_ptr<const DefinedJudge> judge_;
  double shift_ = 0.0;
  std::array<OfKind, kFormulaSpaces * kElementKindCount> kinds_;
};

/// Reason why a metric that is defined by a formula or a target cannot be split into atoms on all these kinds; empty where it can.
[[nodiscard]] std::string defined_joint_obstacle(Metric metric, KindSet kinds);

}  // namespace dmoscope
