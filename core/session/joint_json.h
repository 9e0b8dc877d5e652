#pragma once
// Joint moves in a saved session.

#include <cstddef>

#include "core/run/history.h"
#include "core/session/json_values.h"

namespace dmoscope {

/// Figures as an array: ["none" | "certified" | "no gain", certified, is push, bound, gap, vertices, Newton steps].
[[nodiscard]] StateJson joint_json(const JointFigures& figures);
/// Reads such an array. Throws UsageError, and exceptions of the JSON library.
[[nodiscard]] JointFigures to_joint_figures(const StateJson& json);

/// State as an object: atoms in stretches, state and count alternating; levels as pairs of vertex and level.
[[nodiscard]] StateJson joint_json(const JointState& state);
/// Reads such an object. `vertices`: number of the mesh's vertices. Throws UsageError, and exceptions of the JSON library.
[[nodiscard]] JointState to_joint_state(const StateJson& json, std::size_t vertices);

}  // namespace dmoscope
