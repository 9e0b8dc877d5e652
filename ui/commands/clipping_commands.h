#pragma once
// The window's commands of volume meshes: what is seen of them, and from where.

#include "core/commands/commands.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

/// clip PLANE|on|off|toggle|flip|next | clip-mode crinkle|cut|toggle | peel N|more|less | peel-quality Q|off | keep-quality LO HI|off |
/// worst-cells N|off | ghost-rest on|off | shrink F | show-all | view-from VIEW | turn DX DY | roll X Y X Y | perspective on|off |
/// trackball on|off | orbit-about X Y Z
void add_clipping_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
