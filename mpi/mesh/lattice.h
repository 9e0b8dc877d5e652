#pragma once
// Meshes that ranks make for measuring, each its own part.

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// A jittered lattice of about as many vertices: triangles in the plane or tetrahedra. The same mesh for any number of ranks.
[[nodiscard]] MeshBlock lattice_block(const World& world, std::uint64_t vertices, bool volume);

}  // namespace dmoscope
