#pragma once
// Meshes in longitude and latitude that wrap: some elements have corners at +179 and at -179 degrees, and are as wide as the Earth when
// these numbers are taken as they stand.

#include <string>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

class Topology;
struct EdgeSurvey;

/// Recognises such a mesh and then sets the period of its plane, its file's range (west), where a picture cuts it, and the size of a piece
/// that does not go all around. A mesh wraps when x fits a circle of 360 degrees, y lies within [-90, 90], and unwrapping mends far more of
/// the elements that are wider than half the circle than it breaks. Sound: positive in the winding of the neighbours, and no wider than a
/// quarter of the circle. A mesh that is merely wide stays as it is.
void find_seam(const Mesh& mesh, const Topology& topology, const EdgeSurvey& edges, Geometry& geometry);

/// Might a mesh in this plane, whose used vertices have this box, wrap? Only one that has elements of which is_wide() is true does.
[[nodiscard]] bool might_wrap(const Plane& plane, Vec3 low, Vec3 high);
/// Is an element, as its corners stand, wider than half the circle?
[[nodiscard]] bool is_wide(const Mesh& mesh, Index element);

/// The elements that are wider than half the period as their corners stand; 0 of a mesh that does not wrap.
[[nodiscard]] Index count_seam_elements(const Mesh& mesh, const Plane& plane);

/// The meridian that they cross, for sentences: 180 of a file whose longitudes are -180 to 180. 0 of a mesh that does not wrap.
[[nodiscard]] double meridian_of_seam(const Plane& plane);

/// What pictures of the mesh leave out, one sentence: the elements across the seam of one that goes all around. Empty: nothing.
[[nodiscard]] std::string left_out_of_pictures(Index seam_elements, const Plane& plane);

}  // namespace dmoscope
