#pragma once
// Commands of the inspection of a visit, on plain state.

#include <limits>
#include <string>

#include "ui/analysis/inspection.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   inspect [on|off|toggle] | inspect vertex ID | inspect element ID | inspect-next | inspect-worst
///   level next|back|N|all | play-levels [on|off|toggle] | apply-move | inspect-zoom [on|off|toggle]
///   field [on|off|toggle] | field-in-view [on|off|toggle] | inspect-alone [on|off|toggle] | grid-slice x|y|z|N|next|back|best
///   level-range view|level | copy-level [N] | export-trace FILE.csv
void add_inspection_commands(CommandTable& table, ViewState& state, const CommandHost& host);

/// Next command of playing the levels (empty: none yet), and the seconds after which there may be another one.
struct LevelTurn {
  std::string line;
  double wait = std::numeric_limits<double>::infinity();
};
/// Next turn of playing the levels. `now`: seconds of the window. The caller that runs the line notes in the state since when its level is
/// shown, and plays on until the move is applied.
[[nodiscard]] LevelTurn play_levels(ViewState& state, bool busy, double now);

/// Ends the inspection of a vertex's search, and goes back to the camera before its close-up.
void close_inspection(ViewState& state);
/// Whether a command moves the whole mesh until it is done, so that one vertex is no longer what is looked at.
[[nodiscard]] bool leaves_inspection(std::string_view line);

}  // namespace dmoscope::ui
