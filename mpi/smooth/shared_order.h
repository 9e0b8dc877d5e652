#pragma once
// Values that many ranks have, in order.

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/world/world.h"

namespace dmoscope {

/// The values of these ranks, from 0, among all. `here`: this rank's, ascending, none of them NaN; each of `ranks` below the number of all.
/// All ranks of the world together.
[[nodiscard]] std::vector<double> values_of_ranks(const World& world, std::span<const double> here, std::span<const std::uint64_t> ranks);

}  // namespace dmoscope
