#pragma once
// One winding for the whole mesh; files, above all of SU2, mix windings.

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

class Topology;
struct EdgeSurvey;

struct OrientationReport {
  Index components = 0;      // sets of elements connected across manifold edges
  Index flipped = 0;         // elements whose winding was reversed
  Index contradictions = 0;  // edges across which no consistent winding exists (non-orientable or non-manifold)
};

/// For every element, whether its winding is opposite to that of the first one of its component. Counts the edges where no winding fits.
[[nodiscard]] std::vector<std::uint8_t> relate_windings(const Mesh& mesh, const Topology& topology, Index& contradictions);

/// Makes the winding of planar elements consistent inside each edge-connected component (neighbours across a
/// manifold edge run it in opposite directions), and then positive for the majority of its elements. A tangled element
/// keeps its neighbours' winding and so stays visibly inverted. A component of one element has no neighbour to agree with and keeps
/// the winding it has. Sets mesh.flipped. Idempotent.
OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane);
/// Makes the winding consistent, given the mesh's topology and edges. `edges` stays true but for EdgeSurvey::consistent; if elements were
/// reversed, the topology has to follow() them.
OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane, const Topology& topology, const EdgeSurvey& edges);

// Volumes and orientations of volume elements.

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
