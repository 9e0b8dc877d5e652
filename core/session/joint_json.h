#pragma once
// Joint moves in a saved session.

#include <cstddef>

#include "core/run/history.h"
#include "core/session/json_values.h"

namespace dmoscope {

/// ["none" | "certified" | "no gain", certified, is push, bound, gap, vertices, Newton steps]
[[nodiscard]] StateJson joint_json(const JointFigures& figures);
/// Throws UsageError, or what the JSON library throws.
[[nodiscard]] JointFigures to_joint_figures(const StateJson& json);

/// Atoms in stretches, state and count one after another; levels as vertex and level where there is one.
[[nodiscard]] StateJson joint_json(const JointState& state);
/// `vertices`: of the mesh. Throws likewise.
[[nodiscard]] JointState to_joint_state(const StateJson& json, std::size_t vertices);

}  // namespace dmoscope
