#pragma once
// Common part of the volumes' kernels. Only they include it; see lane_kernel_impl.h for what that asks of the code.

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/smooth/kernels/volume_form.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope::volumes {

/// Searches level after level, from a star that floats tell apart.
template <class Search>
VolumeFound search_levels(const VolumeSearch& task) {
  Search search(task);
  VolumeFound found;
  found.ready = search.begin() > kLeastRank;
  if (!found.ready) return found;
  double omega = task.omega;
  for (int level = 0; level < task.levels; ++level) {
    const auto part = static_cast<float>(omega);
    search.search_level(task.box.x * part, task.box.y * part, task.box.z * part);
    omega *= 2.0 / (task.points - 1);
  }
  found.offset = search.best();
  return found;
}

/// Least number of a pack of doubles.
template <class D>
[[nodiscard]] double least_slot_of(const D& pack) {
  alignas(64) double numbers[D::size];
  pack.store_aligned(numbers);
  double least = numbers[0];
  for (std::size_t k = 1; k < D::size; ++k)
    if (numbers[k] < least) least = numbers[k];
  return least;
}

}  // namespace dmoscope::volumes
