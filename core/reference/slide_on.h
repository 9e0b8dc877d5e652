#pragma once
// Meshes whose vertices slide on the surface of another one: of the part that the mesh was made from, or of an earlier state of it.

#include <memory>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// Returns the mesh with `surface` as its reference: a surface mesh, or a volume mesh, whose boundary counts; null: its own surface again.
/// Its vertices stay in place until they are visited. The elements of a surface mesh are then inverted if they look away from the
/// reference. Throws UsageError if either mesh is planar.
[[nodiscard]] std::shared_ptr<const InputMesh> slide_on(const InputMesh& mesh, std::shared_ptr<const InputMesh> surface);

}  // namespace dmoscope
