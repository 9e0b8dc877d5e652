#pragma once
// What the files of the session's verbs share. Only session_commands.cpp and those files need it.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/session/session_commands.h"

namespace dmoscope {

using Arguments = CommandTable::Arguments;

struct Verb {
  CommandInfo info;
  void (*handler)(CommandContext&, Arguments);
  bool remembered = true;  // what it changes can be undone
};

/// Meshes and files; parameters of the active run; its second aims; its steps; runs and the session; all runs at once.
[[nodiscard]] std::span<const Verb> file_verbs();
[[nodiscard]] std::span<const Verb> parameter_verbs();
[[nodiscard]] std::span<const Verb> aims_verbs();
[[nodiscard]] std::span<const Verb> stepping_verbs();
[[nodiscard]] std::span<const Verb> run_verbs();
[[nodiscard]] std::span<const Verb> comparison_verbs();

/// Throws WrongArguments unless there are so many.
void require(Arguments arguments, std::size_t least, std::size_t most);

void tell(CommandContext& context, std::string text, Message::Kind kind = Message::Kind::Info);

/// Says what the active run holds on interfaces, if anything.
void tell_interfaces(CommandContext& context);

/// Changes the active run's parameters; says so when that made a new run beside the old one.
void change_run(CommandContext& context, const std::function<void(RunParameters&)>& edit);

/// The vertices that words such as "7" or "10-20" name, in their order. Throws WrongArguments, and UsageError for one that does not exist.
[[nodiscard]] std::vector<Index> to_vertices(Arguments words, const Mesh& mesh);

}  // namespace dmoscope
