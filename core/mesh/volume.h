#pragma once
// Volumes and orientations of volume elements.

#include <span>

#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"

namespace dmoscope {

/// Volume that the faces of a volume element enclose, in cubic mesh units; negative if it is inside out. Each face is a fan around the mean
/// of its corners, which is exact for a trilinear hexahedron.
[[nodiscard]] double signed_volume(const Mesh& mesh, Index element);
/// Volume of a volume element, in cubic mesh units, with the vertices at `positions`.
[[nodiscard]] double signed_volume(const ElementTable& elements, std::span<const Vec3> positions, Index element);

/// Turns volume elements so that neighbours across a face run it in opposite directions, and then so that most of each component have
/// positive volume, as normalise_orientation() does for planar ones. If elements were turned, topology and neighbours have to be rebuilt.
/// `neighbours`: those of the mesh.
OrientationReport normalise_orientation(Mesh& mesh, const FaceNeighbours& neighbours);

}  // namespace dmoscope
