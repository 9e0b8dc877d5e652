#pragma once
// The surface of a volume on which vertices slide, and the feature edges on it.

#include <optional>

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/curves.h"
#include "core/reference/sliding_faces.h"
#include "core/reference/standing.h"

namespace dmoscope {

struct SurfaceEnds {
  CurveEnds curves;  // along feature edges
  SlidingFaces faces{};
  std::optional<OntoLines> onto{};  // of a mesh that slides on the surface of another one
};
/// See Domain.
[[nodiscard]] SurfaceEnds surface_ends(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
