#pragma once
// Commands about what would be lost: the question before it is, and what was saved by itself.

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

///   ask-unsaved on|off | answer session|export|discard|cancel | recovery take|discard|later [K]
void add_unsaved_commands(CommandTable& table, ViewState& state, const CommandHost& host);

/// Whether a person must be asked before this line; then the question is put. `at_work`: the session's command; empty: it rests.
[[nodiscard]] bool ask_before(ViewState& state, const SessionView& session, const std::string& at_work, std::string_view line);

/// Once a frame, after the news: the line that may go on now, since nothing would be lost any more; or empty. Where saving came to nothing,
/// the question is put again.
[[nodiscard]] std::string go_on_leaving(ViewState& state, const SessionView& session, bool busy);

}  // namespace dmoscope::ui
