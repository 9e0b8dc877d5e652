#pragma once
// Where in the panels a control is, for scripts and the tour: which tab or fold has to be open for it.

#include <string_view>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Opens the tab or fold that a control belongs to, by its name; nothing for one that is always there or that nobody knows.
void open_home_of(std::string_view item, Panels& panels);

}  // namespace dmoscope::ui
