#pragma once
// Vertices of boundary layers that were made on purpose, so that they are kept unless the user says otherwise.

#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

/// The vertices of pronounced layers (core/target/boundary_layers.h), ascending, without those of inverted elements.
[[nodiscard]] std::vector<Index> layer_vertices(const Mesh& mesh, const Geometry& geometry);

}  // namespace dmoscope
