#pragma once
// The session's commands: what the window's buttons, a script and the tests all say. The tables of *_commands.cpp are their list, and the
// manual page prints it.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
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
  std::function<void(const std::filesystem::path&)> report{};  // writes how the runs compare; null: nobody here does
  bool continues = false;                                      // the next change of parameters goes on from the best state: `continue-with`
};

/// How much of a session a command may change, and so which others it may be carried out in the midst of.
enum class CommandReach {
  Session,  // mesh, runs, parameters: what was asked for before it comes before, what was asked for after it comes after
  Paths,    // where runs stand, and which runs there are; neither the mesh nor what is shown of it
  Look,     // only what is shown: carried out also between two blocks of visits of a command that changes paths
};
/// Of a command line; Session for one that is unknown.
[[nodiscard]] CommandReach reach_of(std::string_view line);

/// The commands in the order of the list above, for help, palette and man page.
[[nodiscard]] const std::vector<CommandInfo>& session_commands();

/// Adds them to `table`; their handlers keep a reference to `context`, which must outlive the table.
void add_session_commands(CommandTable& table, CommandContext& context);

}  // namespace dmoscope
