#pragma once
// Commands of marks and playing.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   mark a|b|clear | flip [a|b|now] | play [on|off|toggle] | play-steps vertex|class|iteration|off | speed N|up|down
void add_timeline_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
