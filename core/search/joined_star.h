#pragma once
// The star of a vertex or, where another one moves with it by the same way, both stars as one.

#include "core/search/mesh_star.h"
#include "core/search/surface_star.h"

namespace dmoscope {

/// As gather_star(); `follower`: whose elements come after the others of their kind, seen from where it stands; kNoIndex: there is none.
void gather_star_with(const MeshView<Plane>& mesh, PositionView positions, Index vertex, Index follower, Star<double>& out);
void gather_star_with(const MeshView<Space>& mesh, PositionView positions, Index vertex, Index follower, VolumeStar<double>& out);
void gather_star_with(const MeshView<Curved>& mesh, PositionView positions, Index vertex, Index follower, SurfaceStar& out);

}  // namespace dmoscope
