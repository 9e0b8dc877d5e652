#pragma once
// Commands with which a recorded session gives the window its look again, and that which saves one.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   camera X Y UNITS-PER-PIXEL | panel-size left|right|bottom|runs EM|default | unfold left|right [on|off|toggle] | save-script FILE |
///   save-session FILE | open-session FILE
void add_desktop_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
