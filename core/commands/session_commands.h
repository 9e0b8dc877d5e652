#pragma once
// The session's commands: what the window's buttons, a script and the tests all say. The tables of *_commands.cpp are their list, and the
// manual page prints it.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/commands/commands.h"
#include "core/commands/message.h"
#include "core/session/session.h"

namespace dmoscope {

/// What a session command works on.
struct CommandContext {
  Session& session;
  Progress& progress;
  std::function<void(Message)> say;
  std::vector<std::string> done{};                 // commands for what the one at work has done besides moving runs; see CommandEnd::again
  std::vector<std::filesystem::path> recovered{};  // files whose session was opened by `recover`
};

/// The commands in the order of the list above, for help, palette and man page.
[[nodiscard]] const std::vector<CommandInfo>& session_commands();

/// Adds them to `table`; their handlers keep a reference to `context`, which must outlive the table.
void add_session_commands(CommandTable& table, CommandContext& context);

}  // namespace dmoscope
