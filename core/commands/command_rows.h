#pragma once
// Interfaces that the files of the session's commands share. Only session_commands.cpp and those files need it.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/commands/session_commands.h"

namespace dmoscope {

struct CommandAction {
  std::size_t least, most;  // numbers of words after the command's name
  std::function<void(CommandContext&, Arguments)> handler;
  bool remembered = true;  // whether its changes can be undone
  CommandReach reach = CommandReach::Session;
};
struct CommandRow {
  CommandInfo info;
  CommandAction action;
};

/// Tables of commands: meshes and files; parameters of the active run; kinds of its vertices and edges; its second aims; its steps; runs
/// and the session; all runs at once.
[[nodiscard]] std::span<const CommandRow> file_commands();
[[nodiscard]] std::span<const CommandRow> parameter_commands();
[[nodiscard]] std::span<const CommandRow> kind_commands();
[[nodiscard]] std::span<const CommandRow> objective_commands();
[[nodiscard]] std::span<const CommandRow> stepping_commands();
[[nodiscard]] std::span<const CommandRow> run_commands();
[[nodiscard]] std::span<const CommandRow> comparison_commands();

void tell(CommandContext& context, std::string text, Message::Kind kind = Message::Kind::Info);

/// Reports the vertices that the active run holds on interfaces, if any.
void tell_interfaces(CommandContext& context);

/// Reports the vertices that slide in the active run, if any.
void tell_sliding(CommandContext& context);

/// Changes the active run's parameters; reports if that made a new run beside the old one. If the context says so, the new run begins from
/// the active run's best state; that setting is then cleared.
void change_run(CommandContext& context, const std::function<void(RunParameters&)>& edit);

/// Parameters of a run like another one, with the method and metric of words such as "dmo:min-angle".
[[nodiscard]] RunParameters run_like(RunParameters parameters, const std::string& words);

/// The vertices that words such as "7" or "10-20" name, in their order. Throws WrongArguments, and UsageError for one that does not exist.
[[nodiscard]] std::vector<Index> to_vertices(Arguments words, const Mesh& mesh);

}  // namespace dmoscope
