#pragma once
// Size of an element's surroundings, by which its Jacobian is divided while it is untangled.

#include <vector>

#include "core/base/progress.h"
#include "core/input/mesh_share.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// Reference measures of all elements, see InputMesh::reference_measure. `share`: null for a whole mesh. Throws Cancelled.
[[nodiscard]] std::vector<double> reference_measures(const Mesh& mesh, const Geometry& geometry, const Topology& topology,
                                                     const MeshShare* share, Progress& progress);

}  // namespace dmoscope
