#pragma once
// Who slides along what in a planar mesh.

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/standing.h"

namespace dmoscope {

/// See Domain.
[[nodiscard]] CurveEnds planar_ends(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
