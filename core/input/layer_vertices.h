#pragma once
// The vertices of boundary layers that somebody has made on purpose, so that they are kept unless told otherwise.

#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

/// The vertices of pronounced layers (core/target/boundary_layers.h), ascending, but of elements that are inverted.
[[nodiscard]] std::vector<Index> layer_vertices(const Mesh& mesh, const Geometry& geometry);

}  // namespace dmoscope
