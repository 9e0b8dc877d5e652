#pragma once
// The window's own verbs, on plain state. Buttons, keys, palette, scripts and tests all come through here.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/session/commands.h"
#include "ui/view_state.h"

namespace dmoscope::ui {

/// What the verbs act on besides the view state. All members must be set.
struct CommandHost {
  std::function<std::shared_ptr<const SessionView>()> session;
  std::function<void(const std::string&)> post;  // a session command
  std::function<bool()> busy;
  std::function<void()> cancel;
  /// Rectangle (left, top, right, bottom in pixels) of a named item of the interface; throws UsageError for an unknown name.
  std::function<std::array<float, 4>(const std::string&)> item;
};

/// The verbs; session verbs are not among them. `state` and `host` must outlive the table.
///   pick vertex|element ID | pick none | goto vertex|element ID | fit | zoom FACTOR | pan DX DY
///   wireframe on|off|toggle | vertices ... | worst ... | colormap NAME | range fixed|auto|LOW HIGH | theme dark|light|contrast|next
///   scale FACTOR|up|down | size W H | full-screen on|off|toggle | panel left|right|bottom on|off|toggle | verbs of plot_commands.h and
///   pane_commands.h dialog NAME|none | screenshot FILE [--size WxH] [--supersample N] [--transparent] [--window] click X Y|ITEM |
///   double-click X Y | right-click X Y | drag X0 Y0 X1 Y1 | move X Y | wheel X Y AMOUNT | key NAME | type TEXT run-pause | cancel |
///   timeline back|forward|first|last | next-run | next-metric | copy TEXT | wait | quit
[[nodiscard]] CommandTable view_commands(ViewState& state, const CommandHost& host);

/// Their names, usage and one line each, for palette and man page.
[[nodiscard]] std::vector<CommandInfo> view_verbs();

/// Sends one line where it belongs: to the window's table when it knows the verb, else to the session. Throws UsageError.
void dispatch(const CommandTable& view, const CommandHost& host, std::string_view line);

/// True when the line's verb is one of the session's.
[[nodiscard]] bool is_session_command(std::string_view line);

/// "1920x1080": width and height, each 1 to 32768. Throws UsageError.
[[nodiscard]] std::pair<int, int> parse_size(const std::string& word);

}  // namespace dmoscope::ui
