#pragma once
// The window's own commands, on plain state. Buttons, keys, palette, scripts and tests all come through here.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/commands/commands.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// What the commands act on besides the view state. All members must be set.
struct CommandHost {
  std::function<std::shared_ptr<const SessionView>()> session;
  std::function<void(const std::string&)> post;  // a session command
  std::function<bool()> busy;
  std::function<void()> cancel;
  /// Rectangle (left, top, right, bottom in pixels) of a named item of the interface; throws UsageError for an unknown name.
  std::function<std::array<float, 4>(const std::string&)> item;
  /// How what smooths reaches the screen; see DrawingPath.
  std::function<std::string()> drawing_path;
};

/// The window's commands; the session's are not among them. `state` and `host` must outlive the table.
[[nodiscard]] CommandTable view_commands(ViewState& state, const CommandHost& host);

/// Their names, usage and one line each, for palette and man page.
[[nodiscard]] std::vector<CommandInfo> view_command_infos();

/// Sends one line where it belongs: to the window's table when it knows the command, else to the session. Throws UsageError.
void dispatch(const CommandTable& view, const CommandHost& host, std::string_view line);

/// True when the line's command is one of the session's.
[[nodiscard]] bool is_session_command(std::string_view line);

/// Throws UsageError for a line whose command is neither the session's nor the view's; names the one that is most likely meant.
void require_known_command(const CommandTable& view, std::string_view line);

/// "1920x1080": width and height, each 1 to 32768. Throws UsageError.
[[nodiscard]] std::pair<int, int> parse_size(const std::string& word);

}  // namespace dmoscope::ui
