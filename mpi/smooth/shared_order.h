#pragma once
// Order statistics of values that ranks share.

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/world/world.h"

namespace dmoscope {

/// Returns the values of these ranks, from 0, among all values. `here`: this rank's, ascending, none of them NaN; each of `ranks` is below
/// the number of all. To be called by all ranks of the world together.
[[nodiscard]] std::vector<double> values_of_ranks(const World& world, std::span<const double> here, std::span<const std::uint64_t> ranks);

}  // namespace dmoscope
