#pragma once
// Colour classes of a mesh that ranks share: the same as those of colour_vertices() for the whole mesh.

#include <vector>

#include "core/mesh/topology.h"
#include "mpi/mesh/share.h"

namespace dmoscope {

inline constexpr Index kNoColour = kNoIndex;

struct SharedColours {
  std::vector<Index> of_vertex;  // kNoColour for fixed vertices; others' vertices have their owners' values
  Index classes = 0;             // number of colours of the whole mesh
  std::uint64_t rounds = 0;      // rounds of messages
};

/// Colours the vertices: each takes the lowest free colour once every free neighbour before it in the mesh has one (Jones and Plassmann
/// 1993), by induction the colour that one process gives it in the mesh's order. `mesh`: of the share; `fixed`: by vertex, the same on all
/// ranks. To be called by all ranks together.
[[nodiscard]] SharedColours colour_shares(const World& world, const Share& share, const Halo& halo, const Mesh& mesh,
                                          const Topology& topology, std::span<const std::uint8_t> fixed);

}  // namespace dmoscope
