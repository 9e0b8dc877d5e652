#pragma once
// The commands of selecting vertices and of what is done with them.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   select vertex|add|remove ID|A-B... | select none | select all-in X0 Y0 X1 Y1 | brush on|off|toggle | brush-radius PIXELS|up|down
///   smooth-selected | fix-selected | click-smooths on|off|toggle
void add_selection_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
