#pragma once
// Vertices that belong to others: what moves one alone parts them.

#include <cstdint>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"

namespace dmoscope {

enum class Tie : std::uint8_t {
  None,
  Periodic,  // the file pairs it with another: see Mesh::periodic
  Double,    // another vertex of the boundary stands at the same place, as at a seam, and no element has both
  Pair       // the mesh is one cell thick: it has a partner on the other side
};

/// Two vertices of the boundary that stand for one: the second is where the first is, moved by `shift`.
struct Partners {
  Index first, second;
  Vec3 shift{};
};
/// The doubles of which only two stand at a place, in the order of the first, which has the lower number; none that the file pairs with
/// others.
[[nodiscard]] std::vector<Partners> find_partners(const Mesh& mesh, const Topology& topology);

/// By vertex. `faces`: of a volume mesh.
[[nodiscard]] std::vector<Tie> find_ties(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces);

/// Whether each wedge or hexahedron of a volume mesh has two opposite faces on its boundary, and there is nothing else.
[[nodiscard]] bool is_one_cell_thick(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces);

}  // namespace dmoscope
