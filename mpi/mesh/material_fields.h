#pragma once
// Choice of a block's fields that tell materials apart.

#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Returns numbers of block.fields, by the rules of materials.h and interfaces.h over the whole mesh: those that name materials or, if
/// there are none, parts of the geometry; of these only fields with different values.
[[nodiscard]] std::vector<std::size_t> material_fields(const World& world, const MeshBlock& block);

}  // namespace dmoscope
