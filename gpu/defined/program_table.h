#pragma once
// The programs of a metric that a mesh's elements need, by groups of elements with the same programs.

#include <cstdint>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/quality/defined_judge.h"

namespace dmoscope::gpu {

/// Properties that the elements of a group have in common.
struct ElementGroup {
  ElementKind kind;
  FormulaSpace space;
  double steepness;
  friend bool operator==(const ElementGroup&, const ElementGroup&) = default;
};

class ProgramTable {
 public:
  /// Makes the programs of all elements. `judge` must outlive the table.
  ProgramTable(const InputMesh& input, const DefinedJudge& judge);

  [[nodiscard]] std::span<const ElementGroup> groups() const noexcept { return groups_; }
  [[nodiscard]] std::span<const std::uint16_t> group_of_element() const noexcept { return group_of_element_; }
  /// The programs by group, kProgramsOfGroup each: see DefinedTask::programs. Null if there is none.
  [[nodiscard]] std::span<const FormulaProgram* const> programs() const noexcept { return programs_; }
  /// Returns the program for places of the corner of an element.
  [[nodiscard]] const FormulaProgram& for_places(const Incidence& at) const;

 private:
  std::vector<ElementGroup> groups_;
  std::vector<std::uint16_t> group_of_element_;
  std::vector<const FormulaProgram*> programs_;
};

}  // namespace dmoscope::gpu
