#pragma once
// The star of a vertex, joined with that of its follower if it has one.

#include "core/search/mesh_star.h"
#include "core/search/surface_star.h"

namespace dmoscope {

/// Gathers the star of a vertex and of its follower. `follower`: a vertex that moves by the same offset; its elements come after the others
/// of their kind, seen from its own place; kNoIndex: none.
void gather_star_with(const MeshView<Plane>& mesh, PositionView positions, Index vertex, Index follower, Star<double>& out);
void gather_star_with(const MeshView<Space>& mesh, PositionView positions, Index vertex, Index follower, VolumeStar<double>& out);
void gather_star_with(const MeshView<Curved>& mesh, PositionView positions, Index vertex, Index follower, SurfaceStar& out);

}  // namespace dmoscope
