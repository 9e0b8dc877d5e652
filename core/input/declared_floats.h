#pragma once
// Text files that declare their points as float (VTK legacy, VTU, PLY) but hold more digits than such a number has. Programs that take the
// word see what is left of them, so that this is what is judged, moved and written.

#include <span>
#include <string>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

void round_to_floats(std::span<Vec3> positions);

/// Puts the coordinates of a mesh on numbers of the types that its file declares. Returns a sentence for a person where that moves a vertex
/// by a ten thousandth of the shortest edge or more, else nothing. Throws InputError, naming `file`, for one that its type cannot hold.
[[nodiscard]] std::string round_to_declared(Mesh& mesh, const std::string& file);

}  // namespace dmoscope
