#pragma once
// What a person should look at where elements of a mesh that ranks share stay inverted.

#include <optional>

#include "core/run/ending.h"
#include "mpi/smooth/rank_share.h"

namespace dmoscope {

/// Of all ranks together, on all; numbers are those of the whole mesh.
[[nodiscard]] InvertedCount count_inverted(const QualityContext& context, PositionView positions, const RankShare& share);
/// As find_left_inverted() has it, with numbers of the whole mesh; on all ranks. None where no element is inverted. All ranks together.
[[nodiscard]] std::optional<LeftInverted> find_left_inverted(const Run& run, const RankShare& share);

}  // namespace dmoscope
