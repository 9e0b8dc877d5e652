#pragma once
// Verbs about the window's files: watching the mesh's, and sequences of pictures.

#include "ui/view_commands.h"

namespace dmoscope::ui {

///   watch [on|off|toggle] | sequence FOLDER [--from I] [--to J] [--every K] [--size WxH] [--window] [--overwrite]
void add_file_verbs(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
