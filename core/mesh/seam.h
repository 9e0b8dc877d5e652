#pragma once
// Meshes in longitude and latitude that wrap: some elements have corners at +179 and at -179 degrees, and are as wide as the Earth if these
// numbers are taken as they stand.

#include <string>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

class Topology;
struct EdgeSurvey;

/// Recognises a mesh that wraps and then sets the period of its plane, its file's range (west), the cut of pictures, and the size of a
/// piece that does not go all around. A mesh wraps when x fits a circle of 360 degrees, y lies within [-90, 90], and unwrapping mends far
/// more of the elements that are wider than half the circle than it breaks. Sound: positive in the winding of the neighbours, and no wider
/// than a quarter of the circle. A mesh that is merely wide stays as it is.
void find_seam(const Mesh& mesh, const Topology& topology, const EdgeSurvey& edges, Geometry& geometry);

/// Whether a mesh in this plane may wrap, by the box of its used vertices. Only a mesh with elements of which is_wide() is true does.
[[nodiscard]] bool might_wrap(const Plane& plane, Vec3 low, Vec3 high);
/// Whether an element, as its corners stand, is wider than half the circle.
[[nodiscard]] bool is_wide(const Mesh& mesh, Index element);

/// Number of elements that are wider than half the period as their corners stand; 0 for a mesh that does not wrap.
[[nodiscard]] Index count_seam_elements(const Mesh& mesh, const Plane& plane);

/// The meridian of the seam, for sentences: 180 for a file whose longitudes are -180 to 180. 0 for a mesh that does not wrap.
[[nodiscard]] double meridian_of_seam(const Plane& plane);

/// Sentence on what pictures of the mesh omit: the elements across the seam of one that goes all around. Empty: nothing.
[[nodiscard]] std::string left_out_of_pictures(Index seam_elements, const Plane& plane);

}  // namespace dmoscope
