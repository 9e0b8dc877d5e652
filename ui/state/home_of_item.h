#pragma once
// Finds a control's place in the panels, for scripts and the tour: the tab or fold that must be open for it.

#include <string_view>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Opens the tab or fold that a control belongs to, by its name; does nothing for a control that is always there or not known.
void open_home_of(std::string_view item, Panels& panels);

}  // namespace dmoscope::ui
