#pragma once
// Facts of the session and the view that decide which actions are possible.

#include "core/view/view.h"
#include "ui/state/actions.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

[[nodiscard]] Situation situation_of(const SessionView& session, const ViewState& state, bool busy);

}  // namespace dmoscope::ui
