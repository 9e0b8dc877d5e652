#pragma once
// The tour's command, and the facts it goes on by. Only for sources of this module.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   tour [on|off|next|offer]
void add_tour_command(CommandTable& table, ViewState& state);

[[nodiscard]] TourFacts tour_facts(const SessionView& session, const ViewState& state, bool busy);

}  // namespace dmoscope::ui
