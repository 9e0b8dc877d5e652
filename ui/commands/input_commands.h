#pragma once
// Commands that play the mouse and the keyboard. Only for sources of this room.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

/// Adds them to `table`; what they play is queued in state.requests.input.
void add_input_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
