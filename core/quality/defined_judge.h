#pragma once
// Judges the elements of a mesh by a metric that is defined by a formula, a target, or both.

#include <array>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/mesh/element_frame.h"
#include "core/mesh/mesh.h"
#include "core/quality/defined_metric.h"
#include "core/quality/given_numbers.h"
#include "core/target/target_table.h"

namespace dmoscope {

/// One metric on one mesh: what of it does not change when vertices move. Immutable.
class DefinedJudge {
 public:
  using Corners = std::array<Vec3, 8>;  // see ElementFrames::gather

  /// `mesh`: with the positions of the input. Throws UsageError: the metric is not defined for it, or its target or fields are
  /// missing; InputError: a metric field has what is no metric.
  DefinedJudge(const DefinedMetric& metric, const Mesh& mesh, const ElementFrames& frames);

  [[nodiscard]] const DefinedMetric& metric() const noexcept { return metric_; }
  [[nodiscard]] const TargetTable& targets() const noexcept { return targets_; }
  [[nodiscard]] bool unit_matters() const noexcept { return unit_matters_; }
  /// Do floats not hold what it computes? They hold no mesh's own unit, and no target that stretches very far.
  [[nodiscard]] bool needs_double() const noexcept { return unit_matters_ || stretches_far_; }

  /// The metric of one element with its corners there. `moving`: of volumes, only what changes with that corner counts; kNoIndex: all.
  /// `origin`: in the frame, of what the corners are relative to.
  [[nodiscard]] double quality(Index element, ElementKind kind, const Corners& corners, Vec3 origin, Index moving = kNoIndex) const;
  /// One of several elements that one program judges together, at most kFormulaBatch.
  struct Placed {
    Index element;
    Corners corners;
    Vec3 origin;
  };
  void qualities(const FormulaProgram& program, std::span<const Placed> elements, double* out) const;
  [[nodiscard]] const FormulaProgram& program_for(Index element, ElementKind kind, Index moving) const {
    return program(kind, targets_.of(element).space, FormulaUse::Elements, dimension_ == 3 ? moving : kNoIndex);
  }

  /// A number that a program is given, but for those of corners and origin. `length`: in mesh units, of the unit of the corners.
  [[nodiscard]] double given(const FormulaInput& input, Index element, const ElementTarget& target, double length) const {
    return numbers().of(input, element, target.matrices, target.steepness, length);
  }
  [[nodiscard]] GivenNumbers numbers() const noexcept { return {fields_.data(), element_count_, dimension_, targets_.mean_measure()}; }
  [[nodiscard]] std::span<const double> fields() const noexcept { return fields_; }
  [[nodiscard]] const FormulaProgram& program(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const {
    return metric_.formula->program(kind, space, use, moving);
  }
  /// From what a program says to the metric.
  [[nodiscard]] static double settled(double value, const ElementTarget& target) { return settled_metric(value, target.steepness); }

 private:
  const DefinedMetric& metric_;  // which lives as long as the program
  TargetTable targets_;
  std::vector<double> fields_;  // by element, one field after the other in the order of Formula::fields()
  std::size_t element_count_ = 0, dimension_ = 2;
  bool unit_matters_ = false, stretches_far_ = false;
};

/// The judges of a mesh, each made when it is first asked for. Any thread may ask.
class DefinedJudges {
 public:
  /// Throws as DefinedJudge does. `mesh`: the input, always the same one.
  [[nodiscard]] std::shared_ptr<const DefinedJudge> of(Metric metric, const Mesh& mesh, const ElementFrames& frames) const;
  /// The same; null where that throws.
  [[nodiscard]] std::shared_ptr<const DefinedJudge> find(Metric metric, const Mesh& mesh, const ElementFrames& frames) const;

 private:
  struct Made {
    std::shared_ptr<const DefinedJudge> judge;
    std::exception_ptr why_not;
  };
  [[nodiscard]] const Made& made(Metric metric, const Mesh& mesh, const ElementFrames& frames) const;
  mutable std::mutex mutex_;
  mutable std::map<Metric, Made> judges_;  // whose places stay
};

}  // namespace dmoscope
