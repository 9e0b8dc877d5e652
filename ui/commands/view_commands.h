#pragma once
// The window's own commands, on plain state. Buttons, keys, palette, scripts and tests all come through here.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/commands/commands.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// State and functions that the commands act on besides the view state. All members must be set.
struct CommandHost {
  std::function<std::shared_ptr<const SessionView>()> session;
  std::function<void(const std::string&)> post;  // sends a command to the session
  std::function<bool()> busy;
  std::function<void()> cancel;
  /// Rectangle (left, top, right, bottom in pixels) of a named item of the interface; throws UsageError for an unknown name.
  std::function<std::array<float, 4>(const std::string&)> item;
  /// Way from the device or processor that smooths to the screen; see DrawingPath.
  std::function<std::string()> drawing_path;
};

/// Table of the window's commands, without the session's. `state` and `host` must outlive the table.
[[nodiscard]] CommandTable view_commands(ViewState& state, const CommandHost& host);

/// Names, usage and one line each of the window's commands, for palette and man page.
[[nodiscard]] std::vector<CommandInfo> view_command_infos();

/// Sends one line where it belongs: to the window's table when it knows the command, else to the session. Throws UsageError.
void dispatch(const CommandTable& view, const CommandHost& host, std::string_view line);

/// Whether the line's command is one of the session's.
[[nodiscard]] bool is_session_command(std::string_view line);

/// Throws UsageError for a line whose command is neither the session's nor the view's; names the one that is most likely meant.
void require_known_command(const CommandTable& view, std::string_view line);

/// Width and height from "1920x1080", each 1 to 32768. Throws UsageError.
[[nodiscard]] std::pair<int, int> parse_size(const std::string& word);

}  // namespace dmoscope::ui
