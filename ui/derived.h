#pragma once
// Values worked out from a frame once, not at every drawing.

#include "ui/panels/panels.h"

namespace dmoscope::ui {

/// Brings `derived` up to date with the session's frame and the view's colour range, plot and selection; cheap when nothing changed.
void refresh(Derived& derived, const ViewState& state, const SessionView& session);

}  // namespace dmoscope::ui
