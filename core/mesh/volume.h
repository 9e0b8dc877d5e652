#pragma once
// Volume elements' sizes and turns.

#include <span>

#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"

namespace dmoscope {

/// What the faces of a volume element enclose, in cubic mesh units; negative where it is inside out. Each face is a fan around the mean of
/// its corners, which is exact for a trilinear hexahedron.
[[nodiscard]] double signed_volume(const Mesh& mesh, Index element);
/// The same with the vertices elsewhere.
[[nodiscard]] double signed_volume(const ElementTable& elements, std::span<const Vec3> positions, Index element);

/// Turns volume elements so that neighbours across a face run it in opposite directions, and then so that the most of each component have
/// positive volume, as normalise_orientation() does for planar ones. Where elements were turned, topology and neighbours have to be made
/// anew. `neighbours`: of the mesh.
OrientationReport normalise_orientation(Mesh& mesh, const FaceNeighbours& neighbours);

}  // namespace dmoscope
