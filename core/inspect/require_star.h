#pragma once
// Checks before examining a star.

#include "core/input/input_mesh.h"

namespace dmoscope {

/// Throws UsageError unless the mesh is of that shape and has the vertex.
void require_vertex(const InputMesh& input, Index vertex, Shape shape = Shape::Planar);

/// Whether the metric is defined for all elements around the vertex.
[[nodiscard]] bool defined_around(const InputMesh& input, Metric metric, Index vertex);

}  // namespace dmoscope
