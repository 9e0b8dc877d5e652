#pragma once
// Numbers of the vertices and elements of pieces in the whole mesh, when many ranks have pieces; those of join_pieces().

#include <span>
#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Numbers of a rank's things among all things.
struct SharedNumbers {
  std::vector<WholeIndex> of_thing;  // by thing
  std::vector<std::uint8_t> first;   // by thing: 1 if it is the first of its number
  Ranges ranges;                     // ranges of the numbers
};

/// Numbers things by their ids, in ascending order; things of one id are one. The first of them, in the ranks' order, represents all. To be
/// called by all ranks together.
[[nodiscard]] SharedNumbers number_by_id(const World& world, std::span<const std::uint64_t> ids);
/// Numbers places in the order of the ranks and of their things; places with the same bits are one. To be called by all ranks together.
[[nodiscard]] SharedNumbers number_by_place(const World& world, std::span<const Vec3> places);

}  // namespace dmoscope
