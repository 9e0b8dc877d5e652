#pragma once
// Commands about unsaved work: the question before it is lost, and sessions that were saved automatically.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   ask-unsaved on|off | answer session|export|discard|cancel | recovery take|discard|later [K]
void add_unsaved_commands(CommandTable& table, ViewState& state, const CommandHost& host);

/// Whether a person must be asked before this line; if so, opens the question. `at_work`: the session's command; empty: none.
[[nodiscard]] bool ask_before(ViewState& state, const SessionView& session, const std::string& at_work, std::string_view line);

/// The line that may go on now, because nothing would be lost any more; or empty. To be called once a frame, after the news. If saving
/// failed, the question is opened again.
[[nodiscard]] std::string go_on_leaving(ViewState& state, const SessionView& session, bool busy);

}  // namespace dmoscope::ui
