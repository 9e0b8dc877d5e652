#pragma once
// Commands of a session, as used by the window's buttons, scripts and tests. The tables of *_commands.cpp list them, and the manual page
// prints them.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/commands/commands.h"
#include "core/session/session.h"

namespace dmoscope {

/// Objects that a session command works on.
struct CommandContext {
  Session& session;
  Progress& progress;
  std::function<void(Message)> say;
  std::vector<std::string> done{};                 // commands for the changes of the present one besides moving runs; see CommandEnd::again
  std::vector<std::filesystem::path> recovered{};  // files of sessions that `recover` opened
  std::function<void(const std::filesystem::path&)> report{};  // writes a comparison of the runs; null: not available
  bool continues = false;  // whether the next change of parameters goes on from the best state: `continue-with`
};

/// Reach of a command within a session, which decides during which others it may be carried out.
enum class CommandReach {
  Session,  // mesh, runs, parameters: carried out strictly in order
  Paths,    // moments of runs, and the list of runs; neither the mesh nor what is shown of it
  Look,     // only what is shown: carried out also between two blocks of visits of a command that changes paths
};
/// Reach of a command line; Session for an unknown one.
[[nodiscard]] CommandReach reach_of(std::string_view line);

/// The commands in the order of their tables, for help, palette and man page.
[[nodiscard]] const std::vector<CommandInfo>& session_commands();

/// Adds the commands to `table`; their handlers keep a reference to `context`, which must outlive the table.
void add_session_commands(CommandTable& table, CommandContext& context);

}  // namespace dmoscope
