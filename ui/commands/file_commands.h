#pragma once
// Commands about the window's files: watching the mesh's, and sequences of pictures.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   watch [on|off|toggle] | sequence FOLDER [--from I] [--to J] [--every K] [--size WxH] [--window] [--overwrite]
void add_file_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
