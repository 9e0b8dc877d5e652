#pragma once
// What the palette (Ctrl+P) offers for what was typed.

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
  std::string name{};    // of an action, without its menu
};

/// Actions, then commands of the window (`window_commands`) and of the session, that hold all words of `text`; all of them for an empty
/// one. A command with words after it is a command to run as it stands, and comes first, but for an action that is called just so. What
/// cannot be done now comes last.
[[nodiscard]] std::vector<PaletteEntry> palette_entries(std::string_view text, const Situation& situation,
                                                        std::span<const CommandInfo> window_commands);

}  // namespace dmoscope::ui
