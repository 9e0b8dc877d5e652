#pragma once
// Targets of the elements of a mesh, as matrices.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/formula/element_numbers.h"
#include "core/mesh/element_frame.h"
#include "core/mesh/mesh.h"
#include "core/numeric/small_matrix.h"
#include "core/target/target.h"

namespace dmoscope {

/// Target of one element. A view of the table's data.
struct ElementTarget {
  FormulaSpace space = FormulaSpace::Plain;
  const double* matrices =
      nullptr;             // dimension x dimension numbers each, row by row. Target: of each corner (of a simplex the first alone)
                           // what its edges are multiplied by from the right; Stretched: one, by which all is from the left
  double steepness = 1.0;  // factor by which the metric falls faster below 1 than elsewhere
};

/// Facts about the target for a person.
struct TargetFacts {
  Index with_target = 0;  // elements whose target is other than the ideal one
  Index degenerate = 0;   // elements that should stay as they were and were inverted or flat: their targets are ideal ones
  std::string phrase{};   // "1,204 elements as they were (boundary layers), 3,012 ideal ones"
};

class TargetTable {
 public:
  /// Metric of an ideal element of a kind after a stretch by `ratio`.
  using OfStretched = std::function<double(ElementKind kind, double ratio)>;
  /// `mesh`: one with the positions of the input. Throws UsageError for a group or field that is not there or cannot be used, InputError
  /// for a metric field with a tensor that is no metric.
  TargetTable(const Target& target, const Mesh& mesh, const ElementFrames& frames, const OfStretched& of_stretched);

  [[nodiscard]] ElementTarget of(Index element) const {
    if (first_.empty() || first_[element] == kNone) return {};
    const std::uint8_t which = which_[element];
    return {spaces_[which / kElementKindCount], matrices_.data() + first_[element] * size_, steepness_[which]};
  }
  /// Matrices of all elements.
  [[nodiscard]] std::span<const double> matrices() const noexcept { return matrices_; }
  [[nodiscard]] const TargetFacts& facts() const noexcept { return facts_; }
  /// Mean of the elements' |area| or |volume| at input.
  [[nodiscard]] double mean_measure() const noexcept { return mean_measure_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  class Maker;

  std::size_t size_ = 4;              // numbers in a matrix
  std::vector<std::uint32_t> first_;  // by element, offset into matrices_; empty: no element has a target
  std::vector<std::uint8_t> which_;   // by element: number of its shape, times kElementKindCount, plus its kind
  std::vector<double> matrices_;
  std::vector<FormulaSpace> spaces_;  // spaces of the shapes
  std::vector<double> steepness_;     // steepness by shape and kind
  TargetFacts facts_;
  double mean_measure_ = 1.0;
};

/// Edges of the ideal element with edges of length 1 at a corner, as columns.
[[nodiscard]] SmallMatrix ideal_edges(ElementKind kind);
/// Edges of an element that leave a corner, as columns. `places`: see ElementFrames::gather.
[[nodiscard]] SmallMatrix edges_at(ElementKind kind, const std::array<Vec3, 8>& places, std::size_t corner);
/// Number of corners of a kind that have a target of their own: those of a simplex share one.
[[nodiscard]] std::size_t matrix_count(ElementKind kind);
/// Metric tensor of a vertex: that of a field with 1 (a size), 3, 6 (MMG's order) or 9 components. `n`: 2 or 3.
[[nodiscard]] SmallMatrix metric_tensor(const Field& field, Index vertex, int n);
/// Returns whether a field may be one of metric tensors.
[[nodiscard]] bool is_metric_field(const Field& field, int n);

}  // namespace dmoscope
