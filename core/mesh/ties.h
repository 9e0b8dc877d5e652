#pragma once
// Ties between vertices: a tied vertex that moves alone parts from its partner.

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

/// Two vertices of the boundary that stand for one: the second is at the place of the first plus `shift`.
struct Partners {
  Index first, second;
  Vec3 shift{};
};
/// Pairs of vertices at one place and periodic pairs of the file, ordered by the first, which has the lower number. Three vertices that
/// stand for one make two pairs or more. Pairs of which one element has both vertices are left out.
[[nodiscard]] std::vector<Partners> find_partners(const Mesh& mesh, const Topology& topology);

/// The tie of each vertex. `faces`: those of a volume mesh.
[[nodiscard]] std::vector<Tie> find_ties(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces);

/// Whether a volume mesh consists of wedges and hexahedra that each have two opposite faces on its boundary.
[[nodiscard]] bool is_one_cell_thick(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces);

}  // namespace dmoscope
