#pragma once
// Meshes for measurements that ranks make, each its own part.

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

/// Makes a jittered lattice of about `vertices` vertices: triangles in the plane or tetrahedra. The same mesh for any number of ranks.
[[nodiscard]] MeshBlock lattice_block(const World& world, std::uint64_t vertices, bool volume);

}  // namespace dmoscope
