#pragma once
// What of the session and the view decides which actions are possible.

#include "core/session/view.h"
#include "ui/actions.h"
#include "ui/view_state.h"

namespace dmoscope::ui {

[[nodiscard]] Situation situation_of(const SessionView& session, const ViewState& state, bool busy);

}  // namespace dmoscope::ui
