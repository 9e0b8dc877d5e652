#pragma once
// Volume elements' sizes and turns.

#include <span>

#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"

namespace dmoscope {

/// Of a volume element, negative where it is inside out: what its faces enclose, each fanned from the mean of its corners (exact for a
/// trilinear hexahedron). Cubic mesh units.
[[nodiscard]] double signed_volume(const Mesh& mesh, Index element);
/// The same with the vertices elsewhere.
[[nodiscard]] double signed_volume(const ElementTable& elements, std::span<const Vec3> positions, Index element);

/// Turns volume elements so that neighbours across a face run it in opposite directions, and then so that the most of each component have
/// positive volume, as normalise_orientation() does for planar ones. Where elements were turned, topology and neighbours have to be made
/// anew. `neighbours`: of the mesh.
OrientationReport normalise_orientation(Mesh& mesh, const FaceNeighbours& neighbours);

}  // namespace dmoscope
