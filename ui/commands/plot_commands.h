#pragma once
// Commands of the plots. Only for sources of this room.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   plot NAME | axis NAME|next | log-scale [on|off|toggle] | plot-x iteration|seconds|toggle
///   plot-zoom all | plot-zoom x|y LOW HIGH | plot-zoom x|y all | plot-zoom box X0 X1 Y0 Y1
///   plot-series NAME [on|off|toggle|only] | plot-series all | plot-bins N
///   plot-copy | plot-save FILE [--size WxH] [--scale N]
void add_plot_commands(CommandTable& table, ViewState& state);

}  // namespace dmoscope::ui
