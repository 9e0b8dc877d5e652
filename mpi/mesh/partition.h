#pragma once
// Partition of the vertices among ranks.

#include <filesystem>
#include <string>
#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Choice of a partition. No result depends on it, only how much the ranks communicate.
struct PartitionChoice {
  enum class Kind { Hilbert, Block, File };
  Kind kind = Kind::Hilbert;  // stretches of a Hilbert curve; of the mesh's order; ranks that a file gives
  std::filesystem::path file{};
};
/// Parses "hilbert", "block" or "file:PATH". Throws UsageError.
[[nodiscard]] PartitionChoice parse_partition(const std::string& word);

/// Returns the rank of each vertex of the block, which is spread evenly. Kind::File: the file has one number a line, for a vertex each,
/// taken modulo the number of ranks. Throws InputError with file and line.
[[nodiscard]] std::vector<int> partition(const World& world, const MeshBlock& block, const PartitionChoice& choice);

// Choice of a block's fields that tell materials apart.

/// Returns numbers of block.fields, by the rules of materials.h and interfaces.h over the whole mesh: those that name materials or, if
/// there are none, parts of the geometry; of these only fields with different values.
[[nodiscard]] std::vector<std::size_t> material_fields(const World& world, const MeshBlock& block);

}  // namespace dmoscope
