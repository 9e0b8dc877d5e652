#pragma once
// Which of a block's fields tell materials apart.

#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Numbers of block.fields, by the rules of materials.h and interfaces.h over the whole mesh: those that name materials or, where none
/// does, parts of the geometry; of these only such as have different values.
[[nodiscard]] std::vector<std::size_t> material_fields(const World& world, const MeshBlock& block);

}  // namespace dmoscope
