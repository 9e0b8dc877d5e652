#pragma once
// Fit of a mesh to the surface of another one.

#include <cstdint>
#include <span>

#include "core/base/progress.h"
#include "core/smooth/task.h"

namespace dmoscope {

/// Draws vertices to their nearest places on the task's surface: those of corners to these, those along feature lines to these lines, and
/// others to the surface. Each goes as far as no element around it becomes inverted and the guard holds; between the rounds all elements
/// are raised, which makes room. Inverted elements are untangled first: where sliding does not do, vertices may leave the surface for that,
/// by at most `distance`, and are drawn back. `fixed`: one entry a vertex, non-zero where it may not move. Returns how many vertices have
/// moved. The same bits for any number of threads.
[[nodiscard]] std::uint64_t fit_to_surface(const SmoothingTask& task, std::span<const std::uint8_t> fixed, double distance,
                                           std::span<Vec3> positions, Progress& progress);

}  // namespace dmoscope
