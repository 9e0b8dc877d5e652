#pragma once
// Verbs of the plots. Only for sources of this room.

#include "ui/view_commands.h"

namespace dmoscope::ui {

/// plot NAME | axis NAME|next | log-scale | plot-x iteration|seconds|toggle | plot-zoom all | plot-zoom x|y LOW HIGH | plot-zoom box X0 X1
/// Y0 Y1 | plot-series NAME|all on|off|toggle | plot-bins N
void add_plot_verbs(CommandTable& table, ViewState& state);

}  // namespace dmoscope::ui
