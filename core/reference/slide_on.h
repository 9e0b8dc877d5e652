#pragma once
// A mesh whose vertices slide on the surface of another one: the part that a mesh was made from, or what it was before it was spoiled.

#include <memory>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// The mesh, to slide on `surface`: a mesh of a curved surface, or of a volume, whose boundary counts; null: on its own surface again. Its
/// vertices stay where they are until they are visited. The elements of a curved surface are then inverted where they look away from the
/// reference. Throws UsageError where either is planar.
[[nodiscard]] std::shared_ptr<const InputMesh> slide_on(const InputMesh& mesh, std::shared_ptr<const InputMesh> surface);

}  // namespace dmoscope
