#pragma once
// The programs of a metric that a mesh's elements need, by groups of elements that are judged alike.

#include <cstdint>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/quality/defined_judge.h"

namespace dmoscope::gpu {

/// What elements of a group have in common.
struct ElementGroup {
  ElementKind kind;
  FormulaSpace space;
  double steepness;
  friend bool operator==(const ElementGroup&, const ElementGroup&) = default;
};

class ProgramTable {
 public:
  /// `judge` must outlive it.
  ProgramTable(const InputMesh& input, const DefinedJudge& judge);

  [[nodiscard]] std::span<const ElementGroup> groups() const noexcept { return groups_; }
  [[nodiscard]] std::span<const std::uint16_t> group_of_element() const noexcept { return group_of_element_; }
  /// By group, kProgramsOfGroup each: see DefinedTask::programs. Null where there is none.
  [[nodiscard]] std::span<const FormulaProgram* const> programs() const noexcept { return programs_; }
  /// For the places of a corner of an element.
  [[nodiscard]] const FormulaProgram& for_places(const Incidence& at) const;

 private:
  std::vector<ElementGroup> groups_;
  std::vector<std::uint16_t> group_of_element_;
  std::vector<const FormulaProgram*> programs_;
};

}  // namespace dmoscope::gpu
