#pragma once
// Entries that the palette (Ctrl+P) offers for a typed text.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/commands/commands.h"
#include "ui/state/actions.h"

namespace dmoscope::ui {

struct PaletteEntry {
  std::string title, detail, command;
  bool possible = true;
  bool complete = true;  // false: the command still needs words; choosing it puts it into the line
  std::string name{};    // name of an action, without its menu
};

/// Actions, then commands of the window (`window_commands`) and of the session, that hold all words of `text`; all of them for an empty
/// one. A command with words after it is run as it stands, and comes first, except after an action with exactly that name. Entries that are
/// impossible now come last.
[[nodiscard]] std::vector<PaletteEntry> palette_entries(std::string_view text, const Situation& situation,
                                                        std::span<const CommandInfo> window_commands);

}  // namespace dmoscope::ui
