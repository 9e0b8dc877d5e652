#pragma once
// Colour classes of a mesh that many ranks have: the very classes that colour_vertices() finds for all of it.

#include <vector>

#include "core/mesh/topology.h"
#include "mpi/mesh/halo.h"

namespace dmoscope {

inline constexpr Index kNoColour = kNoIndex;

struct SharedColours {
  std::vector<Index> of_vertex;  // kNoColour of fixed vertices; of others' vertices as their owners say
  Index classes = 0;             // of the whole mesh
  std::uint64_t rounds = 0;      // of messages
};

/// A vertex takes the lowest colour that is free once each free neighbour before it in the mesh has one (Jones and Plassmann 1993): by
/// induction the colour that it gets when one process goes through all in order. `mesh`: of the share; `fixed`: by vertex, agreed on. All
/// ranks together.
[[nodiscard]] SharedColours colour_shares(const World& world, const Share& share, const Halo& halo, const Mesh& mesh,
                                          const Topology& topology, std::span<const std::uint8_t> fixed);

}  // namespace dmoscope
