#pragma once
// The commands of what the view shows of stepping.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   next-class on|off|toggle | arrows off|input|previous|a|b [toggle] | arrow-scale FACTOR|auto|up|down | ghost off|input|previous|a|b
///   [toggle]
void add_stepping_commands(CommandTable& table, ViewState& state);

}  // namespace dmoscope::ui
