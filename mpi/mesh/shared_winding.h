#pragma once
// Turns elements over so that neighbours are wound alike, in a mesh that ranks share.

#include "core/mesh/faces.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"
#include "mpi/mesh/share.h"

namespace dmoscope {

/// Orients the share's elements as normalise_orientation() does for the whole mesh, and returns how many were turned. `faces`: null for a
/// planar mesh. To be called by all ranks together. Throws InputError on all ranks if no winding suits connected elements (a Moebius
/// strip), which the order of the whole mesh's elements decides.
[[nodiscard]] Index orient_share(const World& world, const Share& share, Mesh& mesh, const Geometry& geometry, const Topology& topology,
                                 const FaceNeighbours* faces);

}  // namespace dmoscope
