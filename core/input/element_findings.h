#pragma once
// Findings about single elements of a mesh that was read.

#include <functional>

#include "core/base/progress.h"
#include "core/mesh/plane.h"
#include "core/mesh/report.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// Adds the degenerate elements, and the others that are inverted, to the report. Throws Cancelled.
void find_bad_elements(const Mesh& mesh, const Geometry& geometry, MeshReport& report, Progress& progress);

/// Whether the mesh has strays, see InputMesh::has_strays. `report`: with the inverted elements. Only vertices for which `asked` is true
/// are examined.
[[nodiscard]] bool find_strays(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const MeshReport& report,
                               const std::function<bool(Index)>& asked);

}  // namespace dmoscope
