#pragma once
// Rules that hold vertices that could slide: corners, and the meaning that the file gives them.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/ties.h"
#include "core/reference/curve_ends.h"
#include "core/reference/named_edges.h"
#include "core/reference/standing.h"

namespace dmoscope {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Holds vertices where their curve turns by more than the corner angle, unless the user said that they are no corners, or where it has no
/// direction.
void hold_corners(const InputMesh& input, const StandingRule& rule, CurveEnds& ends);
/// Holds vertices of a curve between two edges that different groups name.
void hold_ends_of_names(const NamedEdges& names, CurveEnds& ends);
/// Holds points that the file names, except in lists that enumerate everything, and the corners of required elements and faces.
void hold_named_points(const InputMesh& input, CurveEnds& ends);

/// Holds vertices that are tied to others, except partners, which may move together.
void hold_tied(const InputMesh& input, CurveEnds& ends);
/// Holds partners that do not both slide between corresponding neighbours, all shifted alike (periodic sides that are turned against each
/// other). `faces`: the faces on which vertices of a volume slide. To be called after all other rules.
void hold_parting(const InputMesh& input, const ElementTable& faces, CurveEnds& ends);
/// Pairs of vertices that may slide as one, of meshes that slide along their own curves and surfaces.
[[nodiscard]] std::vector<Partners> partners_of(const InputMesh& input);

}  // namespace dmoscope
