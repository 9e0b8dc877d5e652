#include "app/window/script.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "app/window/desktop.h"
#include "app/window/headless.h"
#include "app/window/window.h"
#include "core/commands/commands.h"
#include "core/engine/engine.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::app {
namespace {

void tell(const Message& message) {
  if (message.kind == Message::Kind::Info) print("{}\n", message.text);
  if (message.kind == Message::Kind::Warning) complain("warning: " + message.text);
  std::fflush(stdout);
}

/// Whether some line needs the window: any command that is not the session's (an unknown one is then refused with all names).
bool needs_window(const std::vector<std::string>& lines) {
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return !split_words(line).empty() && !ui::is_session_command(line); });
}

/// Whether the script ends with this message. A cancelled line ends it as an error does, unless the script cancels its own work by a
/// command of the window.
bool ends_script(const Message& message, const std::string& line) {
  return message.kind == Message::Kind::Error || (message.exit_code != 0 && ui::is_session_command(line));
}

int fail(const ScriptOptions& options, std::size_t line, const Message& message) {
  std::fflush(stdout);
  complain(fmt::format("{}:{}: {}", options.name, line + 1, message.text));
  return std::max(1, message.exit_code);
}

/// Prints the messages of a line, except one that ends the script, and returns that or the earlier failure.
std::optional<Message> hear(const std::vector<Message>& messages, const std::string& line, std::optional<Message> failure = {}) {
  for (const Message& message : messages) {
    if (!failure && ends_script(message, line)) {
      failure = message;
    } else {
      tell(message);
    }
  }
  return failure;
}

int run_in_engine(const ScriptOptions& options) {
  Engine engine(options.threads, acceleration_for(options.backend), options.backend);
  engine.set_report_writer(options.report);
  if (options.most_memory != 0) engine.post(fmt::format("max-memory {}", options.most_memory));
  for (std::size_t k = 0; k < options.lines.size(); ++k) {
    if (split_words(options.lines[k]).empty()) continue;
    engine.post(options.lines[k]);
    engine.wait_idle();
    if (const auto failure = hear(engine.take_messages(), options.lines[k])) return fail(options, k, *failure);
  }
  return 0;
}

template <class Window>
int run_in_window(Window& window, const ScriptOptions& options) {
  if (options.most_memory != 0) (void)window.run(fmt::format("max-memory {}", options.most_memory));
  for (std::size_t k = 0; k < options.lines.size() && !window.quit(); ++k) {
    if (split_words(options.lines[k]).empty()) continue;
    std::optional<Message> failure = window.run(options.lines[k]);
    failure = hear(window.said(), options.lines[k], std::move(failure));
    if (failure) return fail(options, k, *failure);
  }
  return 0;
}

int run_in_headless_window(const ScriptOptions& options) {
  HeadlessWindow window({options.width, options.height, options.scale, options.threads, options.backend});
  window.app().engine().set_report_writer(options.report);
  return run_in_window(window, options);
}

int run_on_screen(const ScriptOptions& options) {
  require_display();
  WindowOptions look;
  look.threads = options.threads;
  look.backend = options.backend;
  look.scale = options.scale;
  look.scripted = true;
  look.report = options.report;
  Desktop window(look);
  return run_in_window(window, options);
}

}  // namespace

int run_script(const ScriptOptions& options) {
  ui::ViewState state;
  const ui::CommandHost host;  // for looking up the subcommands alone
  const CommandTable view = ui::view_commands(state, host);
  for (std::size_t k = 0; k < options.lines.size(); ++k) {
    try {
      ui::require_known_command(view, options.lines[k]);
    } catch (const UsageError& error) {
      return fail(options, k, {Message::Kind::Error, error.what(), error.exit_code()});
    }
  }
  if (!options.headless) return run_on_screen(options);
  return needs_window(options.lines) ? run_in_headless_window(options) : run_in_engine(options);
}

}  // namespace dmoscope::app
