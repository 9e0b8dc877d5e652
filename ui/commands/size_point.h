#pragma once
// The point of a run's size function: placed with the mouse, and marked on the mesh. Plain state; no ImGui, no OpenGL.

#include <string>

#include "core/view/view.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   place-size-point [on|off|toggle]
void add_size_point_commands(CommandTable& table, ViewState& state, const CommandHost& host);

/// The point of the run's size function; null: it has none.
[[nodiscard]] const Vec3* size_point_of(const RunView& run);

/// The session's command that puts the point at a pixel of the viewport.
[[nodiscard]] std::string size_point_command(const ViewState& state, const InputMesh& input, Vec2<double> pixel);

}  // namespace dmoscope::ui
