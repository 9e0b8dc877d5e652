#pragma once
// Findings of prepare_input() about a volume mesh.

#include "core/base/progress.h"
#include "core/mesh/faces.h"
#include "core/mesh/plane.h"
#include "core/mesh/report.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// Findings of a volume mesh whose orientation is normalised; `components`: see OrientationReport. Throws Cancelled.
[[nodiscard]] MeshReport examine_volume(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours& faces,
                                        Index components, Progress& progress);

}  // namespace dmoscope
