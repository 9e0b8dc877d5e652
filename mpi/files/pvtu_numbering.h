#pragma once
// What the vertices and elements of pieces are in the whole mesh, where many ranks have pieces: as join_pieces() numbers them.

#include <span>
#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Which of all things a rank's things are.
struct SharedNumbers {
  std::vector<WholeIndex> of_thing;  // by thing
  std::vector<std::uint8_t> first;   // by thing: 1 where it stands for all of its number
  Ranges ranges;                     // of the numbers
};

/// Things of one id are one; they count in the order of the ids. The first of them, in the ranks' order, stands for all. All ranks
/// together.
[[nodiscard]] SharedNumbers number_by_id(const World& world, std::span<const std::uint64_t> ids);
/// Those at one place, to the bit, are one; they count in the order of the ranks and of their things. All ranks together.
[[nodiscard]] SharedNumbers number_by_place(const World& world, std::span<const Vec3> places);

}  // namespace dmoscope
