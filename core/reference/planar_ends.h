#pragma once
// Sliding vertices of a planar mesh and their neighbours along curves.

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/standing.h"

namespace dmoscope {

/// The vertices that slide in a planar mesh under a rule, see Domain.
[[nodiscard]] CurveEnds planar_ends(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
