#pragma once
// Commands of colours, filter and labels. Only for sources of this room.

#include <optional>
#include <string_view>

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

/// Adds colormap, reverse-colors, color-steps, range, color-by, filter, filter-mode, isolate, worst-view, fit-worst, labels.
void add_colouring_commands(CommandTable& table, ViewState& state, const CommandHost& host);

/// Whether the action of this id has a mark in the menu; none: it is not one of colours.
[[nodiscard]] std::optional<bool> colouring_checked(const ViewState& state, std::string_view id);

}  // namespace dmoscope::ui
