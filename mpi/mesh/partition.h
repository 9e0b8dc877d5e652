#pragma once
// Which rank gets which vertex.

#include <filesystem>
#include <string>
#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// How vertices are dealt to ranks. No result depends on it, only how much the ranks have to tell each other.
struct PartitionChoice {
  enum class Kind { Hilbert, Block, File };
  Kind kind = Kind::Hilbert;  // pieces of a Hilbert curve; or in the order of the mesh; or as a file says
  std::filesystem::path file{};
};
/// "hilbert", "block" or "file:PATH". Throws UsageError.
[[nodiscard]] PartitionChoice parse_partition(const std::string& word);

/// The rank of each vertex of the block, which is spread evenly. Of Kind::File: one number a line, a vertex each, taken modulo the number
/// of ranks. Throws InputError with file and line.
[[nodiscard]] std::vector<int> partition(const World& world, const MeshBlock& block, const PartitionChoice& choice);

}  // namespace dmoscope
