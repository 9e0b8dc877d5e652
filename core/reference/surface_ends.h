#pragma once
// The surface of a volume on which vertices slide, and the feature edges on it.

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/facets.h"
#include "core/reference/standing.h"

namespace dmoscope {

struct SurfaceEnds {
  CurveEnds curves;  // along feature edges; who is off all of them, and not held, may slide on the surface
  Facets facets{};
};
/// See Domain.
[[nodiscard]] SurfaceEnds surface_ends(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
