#pragma once
// Text files that declare their points as float (VTK legacy, VTU, PLY) but hold more digits than a float has. Programs that respect the
// declaration read rounded coordinates, so these are judged, moved and written here.

#include <span>
#include <string>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

void round_to_floats(std::span<Vec3> positions);

/// Rounds the coordinates of a mesh to the types that its file declares. Returns a sentence for the user if that moves a vertex by a ten
/// thousandth of the shortest edge or more, else nothing. Throws InputError, naming `file`, for a coordinate that its type cannot hold.
[[nodiscard]] std::string round_to_declared(Mesh& mesh, const std::string& file);

}  // namespace dmoscope
