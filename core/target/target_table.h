#pragma once
// What each element of a mesh is wished to be, as matrices.

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

/// Of one element. A view of the table's.
struct ElementTarget {
  FormulaSpace space = FormulaSpace::Plain;
  const double* matrices =
      nullptr;             // dimension x dimension numbers each, row by row. Target: of each corner (of a simplex the first alone)
                           // what its edges are multiplied by from the right; Stretched: one, by which all is from the left
  double steepness = 1.0;  // how much faster than elsewhere the metric falls below 1
};

/// What the target is made of, by a person's words.
struct TargetFacts {
  Index with_target = 0;  // elements whose target is other than the ideal one
  Index degenerate = 0;   // elements that should stay as they were and were inverted or flat: ideal ones are wished instead
  std::string phrase{};   // "1,204 elements as they were (boundary layers), 3,012 ideal ones"
};

class TargetTable {
 public:
  /// What the metric is for an ideal element of a kind that was stretched so many times.
  using OfStretched = std::function<double(ElementKind kind, double ratio)>;
  /// `mesh`: with the positions of the input. Throws UsageError: a group or field that is not there or cannot be used; InputError:
  /// a metric field has what is no metric.
  TargetTable(const Target& target, const Mesh& mesh, const ElementFrames& frames, const OfStretched& of_stretched);

  [[nodiscard]] ElementTarget of(Index element) const {
    if (first_.empty() || first_[element] == kNone) return {};
    const std::uint8_t which = which_[element];
    return {spaces_[which / kElementKindCount], matrices_.data() + first_[element] * size_, steepness_[which]};
  }
  /// Where all elements' matrices are.
  [[nodiscard]] std::span<const double> matrices() const noexcept { return matrices_; }
  [[nodiscard]] const TargetFacts& facts() const noexcept { return facts_; }
  /// Mean of the elements' |area| or |volume| at input.
  [[nodiscard]] double mean_measure() const noexcept { return mean_measure_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  class Maker;

  std::size_t size_ = 4;              // numbers a matrix
  std::vector<std::uint32_t> first_;  // by element, into matrices_; empty: no element has a target
  std::vector<std::uint8_t> which_;   // by element: of the shapes, times kElementKindCount, plus its kind
  std::vector<double> matrices_;
  std::vector<FormulaSpace> spaces_;  // of the shapes
  std::vector<double> steepness_;     // of the shapes and kinds
  TargetFacts facts_;
  double mean_measure_ = 1.0;
};

/// The edges of the ideal element with edges of length 1 at a corner, as columns.
[[nodiscard]] SmallMatrix ideal_edges(ElementKind kind);
/// The edges of an element that leave a corner, as columns. `places`: see ElementFrames::gather.
[[nodiscard]] SmallMatrix edges_at(ElementKind kind, const std::array<Vec3, 8>& places, std::size_t corner);
/// How many corners of a kind have a target of their own: those of a simplex share one.
[[nodiscard]] std::size_t matrix_count(ElementKind kind);
/// The metric tensor of a vertex: that of a field with 1 (a size), 3, 6 (MMG's order) or 9 components. `n`: 2 or 3.
[[nodiscard]] SmallMatrix metric_tensor(const Field& field, Index vertex, int n);
/// May it be one?
[[nodiscard]] bool is_metric_field(const Field& field, int n);

}  // namespace dmoscope
