#pragma once
// The window's commands of viewports side by side.

#include "core/commands/commands.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

/// viewports 1|2|4|split | pane K CONTENT | focus-pane K | link-cameras on|off | pane-camera K X Y UNITS-PER-PIXEL | split X
void add_pane_commands(CommandTable& table, ViewState& state);

}  // namespace dmoscope::ui
