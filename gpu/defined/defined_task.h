#pragma once
// What lanes know of a metric that is defined by a formula or a target, as plain data.

#include "core/quality/given_numbers.h"
#include "core/smooth/reference_visit.h"
#include "gpu/defined/program_code.h"
#include "gpu/defined/star_search.h"

namespace dmoscope::gpu {

/// Every pointer is one of the device's.
struct DefinedTask {
  /// By group of elements, kProgramsOfGroup each: those for places, by the moving corner; from kElements on those for elements, by the
  /// corner that counts; the last for whole elements.
  const ProgramCode* programs = nullptr;
  static constexpr std::size_t kElements = 8, kWhole = 16;
  // The targets. A group's elements are alike but for their matrices.
  const double* matrices = nullptr;
  const std::uint32_t* first_matrix = nullptr;  // by element, in matrices
  const double* steepness_of_group = nullptr;
  GivenNumbers given;
  bool is_volume = false, in_double = false;

  // For the searches by the mean ratio against targets. Planar: see StarTargets; of volumes: see TetrahedronTargets.
  const double* star_targets = nullptr;  // null: they are not for this metric
  const std::uint32_t* first_target = nullptr;
  const std::uint8_t* fits = nullptr;
  bool crossed = false;

  StarSearchTask search;
  StarState* before = nullptr;  // of the stretch's stars, by rank

  double* registers = nullptr;  // for the programs that lanes run step by step
  std::size_t lanes = 0;        // at most so many at once

  /// In a lane's own memory, whether it computes with floats or doubles: another lane may be where it does the other.
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
