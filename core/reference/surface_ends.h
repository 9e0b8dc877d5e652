#pragma once
// The surface on which the vertices of a volume or surface mesh slide, and its feature edges.

#include <optional>

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/curves.h"
#include "core/reference/sliding_faces.h"
#include "core/reference/standing.h"

namespace dmoscope {

struct SurfaceEnds {
  CurveEnds curves;  // neighbours along feature edges
  SlidingFaces faces{};
  std::optional<OntoLines> onto{};  // feature lines of another mesh, if it slides on that one's surface
};
/// The surface and the vertices that slide on it under a rule, see Domain.
[[nodiscard]] SurfaceEnds surface_ends(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
