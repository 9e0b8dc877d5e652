#pragma once
// A metric that is defined by a formula or a target, as plain data for lanes.

#include "core/quality/given_numbers.h"
#include "core/smooth/reference_visit.h"
#include "gpu/defined/program_code.h"
#include "gpu/defined/star_search.h"

namespace dmoscope::gpu {

/// Programs, targets and stars of a defined metric. All pointers are to memory of the device.
struct DefinedTask {
  /// Programs by group of elements, kProgramsOfGroup each: first those for places, by the moving corner; from kElements on those for
  /// elements, by the corner that is judged; the last for whole elements.
  const ProgramCode* programs = nullptr;
  static constexpr std::size_t kElements = 8, kWhole = 16;
  // Targets of the elements. The elements of a group differ in their matrices alone.
  const double* matrices = nullptr;
  const std::uint32_t* first_matrix = nullptr;  // by element, counted in matrices
  const double* steepness_of_group = nullptr;
  GivenNumbers given;
  bool is_volume = false, in_double = false;

  // Data for the searches by the mean ratio against targets. Planar meshes: see StarTargets; volume meshes: see TetrahedronTargets.
  const double* star_targets = nullptr;  // null: the metric has no such search
  const std::uint32_t* first_target = nullptr;
  const std::uint8_t* fits = nullptr;
  bool crossed = false;

  StarSearchTask search;
  StarState* before = nullptr;  // states of the stretch's stars, by rank

  double* registers = nullptr;  // for the programs that lanes run step by step
  std::size_t lanes = 0;        // greatest number of lanes at once

  /// Registers in a lane's own memory, apart from other lanes', which may compute in the other precision.
  template <class Real>
  [[nodiscard]] DMOSCOPE_LANE Registers<Real> registers_of(std::size_t lane) const {
    return {reinterpret_cast<Real*>(registers + lane), lanes * (sizeof(double) / sizeof(Real))};
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE const ProgramCode& program(Index element, std::size_t which) const {
    return programs[search.group_of_element[element] * kProgramsOfGroup + which];
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE double number(const FormulaInput& input, Index element, double length) const {
    const std::size_t first = first_matrix[element] * given.dimension * given.dimension;
    return given.of(input, element, matrices + first, steepness_of_group[search.group_of_element[element]], length);
  }
};

}  // namespace dmoscope::gpu
