#pragma once
// Verbs that look into a visit, on plain state.

#include "ui/inspection.h"
#include "ui/view_commands.h"

namespace dmoscope::ui {

///   inspect [on|off|toggle] | inspect vertex ID | inspect element ID | inspect-next | inspect-worst
///   level next|back|N|all | play-levels [on|off|toggle] | apply-move | inspect-zoom [on|off|toggle]
///   field [on|off|toggle] | field-in-view [on|off|toggle] | level-range view|level | copy-level [N] | export-trace FILE.csv
void add_inspection_verbs(CommandTable& table, ViewState& state, const CommandHost& host);

/// While the levels play: shows the next one when its time has come, and at last applies the move. Returns after how many seconds there is
/// something to do; infinity when nothing plays. `now`: seconds of the window.
double play_levels(ViewState& state, const CommandHost& host, double now);

}  // namespace dmoscope::ui
