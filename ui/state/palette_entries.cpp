#include "ui/state/palette_entries.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/commands/session_commands.h"

namespace dmoscope::ui {

std::vector<PaletteEntry> palette_entries(std::string_view text, const Situation& situation, std::span<const CommandInfo> window_commands) {
  const std::string_view command = text.substr(0, text.find(' '));
  const bool has_words = text.find_first_not_of(' ', command.size()) != std::string_view::npos;
  std::vector<const CommandInfo*> commands;
  for (const std::span<const CommandInfo> table : {window_commands, std::span<const CommandInfo>(session_commands())}) {
    for (const CommandInfo& one : table) commands.push_back(&one);
  }
  std::vector<PaletteEntry> entries;
  for (const CommandInfo* one : commands) {
    if (has_words && one->name == command) entries.push_back({fmt::format("run: {}", text), one->usage, std::string(text), true, true});
  }
  for (const Action* action : search_actions(text)) {
    const std::string title = title_of(*action, situation);
    entries.push_back({fmt::format("{}: {}", action->menu, title), std::string(action->key), std::string(action->command),
                       enabled(*action, situation), true, title});
  }
  const std::vector<std::string> words = search_words(text);
  // Commands that begin with the typed text come before those that only contain it.
  for (const bool begins : {true, false}) {
    for (const CommandInfo* one : commands) {
      if ((has_words && one->name == command) || one->name.starts_with(command) != begins) continue;
      if (!holds_all(one->usage + "\n" + one->doc, words)) continue;
      const bool complete = one->usage == one->name;
      entries.push_back({one->usage, one->doc, complete ? one->name : one->name + " ", true, complete});
    }
  }
  // Entries that are impossible now come last, and those with exactly this name first.
  std::ranges::stable_sort(entries, {}, [&](const PaletteEntry& one) { return one.possible ? one.name == text ? 0 : 1 : 2; });
  return entries;
}

}  // namespace dmoscope::ui
