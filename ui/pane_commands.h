#pragma once
// The window's verbs of viewports side by side.

#include "core/session/commands.h"
#include "ui/view_commands.h"

namespace dmoscope::ui {

/// viewports 1|2|4|split | pane K CONTENT | focus-pane K | link-cameras on|off | pane-camera K X Y UNITS-PER-PIXEL | split X
void add_pane_verbs(CommandTable& table, ViewState& state);

}  // namespace dmoscope::ui
