#pragma once
// Targets of tetrahedra as KernelSet::target_volume reads them.

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "core/target/target_table.h"

namespace dmoscope {

class TetrahedronTargets {
 public:
  TetrahedronTargets(const TargetTable& targets, const Mesh& mesh);
  /// Makes the targets of the elements of one star, numbered as it has them.
  TetrahedronTargets(const TargetTable& targets, const Mesh& mesh, std::span<const Incidence> star);

  /// Returns whether any element has a target that is crossed (see solid_target.h).
  [[nodiscard]] bool crossed() const noexcept { return crossed_; }
  [[nodiscard]] const double* numbers() const noexcept { return numbers_.data(); }
  [[nodiscard]] std::span<const double> all_numbers() const noexcept { return numbers_; }
  /// By element, non-zero where the kernel can search a star that has it.
  [[nodiscard]] std::span<const std::uint8_t> fits() const noexcept { return fits_; }
  /// Returns whether there is any element for which the kernel is made.
  [[nodiscard]] bool any() const noexcept { return any_; }
  /// Returns whether a star has tetrahedra alone, whose metric falls as fast as elsewhere and whose targets floats can hold.
  [[nodiscard]] bool fit(std::span<const Incidence> star) const {
    for (const Incidence& at : star)
      if (fits_[at.element] == 0) return false;
    return true;
  }

 private:
  void add(const TargetTable& targets, const Mesh& mesh, Index element);
  bool crossed_ = false, any_ = false;
  std::vector<std::uint8_t> fits_;  // by element
  std::vector<double> numbers_;
};

}  // namespace dmoscope
