#pragma once
// Turns elements over so that neighbours are wound alike, in a mesh that many ranks have.

#include "core/mesh/faces.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"
#include "mpi/mesh/share.h"

namespace dmoscope {

/// As normalise_orientation() does it for all of the mesh; how many elements of the share were turned. `faces`: null of a planar mesh.
/// All ranks together. Throws InputError on all ranks where elements hang together in a way that no winding suits (a Moebius strip), which
/// the order of the whole mesh's elements decides.
[[nodiscard]] Index orient_share(const World& world, const Share& share, Mesh& mesh, const Geometry& geometry, const Topology& topology,
                                 const FaceNeighbours* faces);

}  // namespace dmoscope
