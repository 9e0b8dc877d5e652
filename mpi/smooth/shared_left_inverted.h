#pragma once
// Examples of elements that stay inverted in a mesh that ranks share.

#include <optional>

#include "core/run/ending.h"
#include "mpi/smooth/rank_share.h"

namespace dmoscope {

/// Counts the inverted elements of all ranks, on all ranks together; numbers are those of the whole mesh.
[[nodiscard]] InvertedCount count_inverted(const QualityContext& context, PositionView positions, const RankShare& share);
/// Finds the examples of find_left_inverted(), with numbers of the whole mesh, on all ranks together. None if no element is inverted.
[[nodiscard]] std::optional<LeftInverted> find_left_inverted(const Run& run, const RankShare& share);

}  // namespace dmoscope
