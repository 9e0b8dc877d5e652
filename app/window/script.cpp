#include "app/window/script.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/window/desktop.h"
#include "app/window/headless.h"
#include "app/window/window.h"
#include "core/session/commands.h"
#include "core/session/engine.h"
#include "ui/view_commands.h"

namespace dmoscope::app {
namespace {

void print(const Message& message) {
  if (message.kind == Message::Kind::Info) std::printf("%s\n", message.text.c_str());
  if (message.kind == Message::Kind::Warning) std::fprintf(stderr, "warning: %s\n", message.text.c_str());
  std::fflush(stdout);
}

/// True when some line needs the window: any verb that is not the session's (an unknown one is then refused with all names).
bool needs_window(const std::vector<std::string>& lines) {
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return !split_words(line).empty() && !ui::is_session_command(line); });
}

int fail(const ScriptOptions& options, std::size_t line, const Message& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s:%zu: %s\n", options.name.c_str(), line + 1, message.text.c_str());
  return std::max(1, message.exit_code);
}

int run_in_engine(const ScriptOptions& options) {
  Engine engine(options.threads);
  for (std::size_t k = 0; k < options.lines.size(); ++k) {
    if (split_words(options.lines[k]).empty()) continue;
    engine.post(options.lines[k]);
    engine.wait_idle();
    std::optional<Message> failure;
    for (const Message& message : engine.take_messages()) {
      print(message);
      if (message.kind == Message::Kind::Error && !failure) failure = message;
    }
    if (failure) return fail(options, k, *failure);
  }
  return 0;
}

template <class Window>
int run_in_window(Window& window, const ScriptOptions& options) {
  for (std::size_t k = 0; k < options.lines.size() && !window.quit(); ++k) {
    if (split_words(options.lines[k]).empty()) continue;
    const std::optional<Message> failure = window.run(options.lines[k]);
    for (const Message& message : window.said()) print(message);
    if (failure) return fail(options, k, *failure);
  }
  return 0;
}

int run_in_headless_window(const ScriptOptions& options) {
  HeadlessWindow window({options.width, options.height, options.scale, options.threads});
  return run_in_window(window, options);
}

int run_on_screen(const ScriptOptions& options) {
  require_display();
  WindowOptions look;
  look.threads = options.threads;
  look.scale = options.scale;
  look.scripted = true;
  Desktop window(look);
  return run_in_window(window, options);
}

}  // namespace

int run_script(const ScriptOptions& options) {
  for (std::size_t k = 0; k < options.lines.size(); ++k) {
    try {
      (void)split_words(options.lines[k]);
    } catch (const UsageError& error) {
      return fail(options, k, {Message::Kind::Error, error.what(), error.exit_code()});
    }
  }
  if (!options.headless) return run_on_screen(options);
  return needs_window(options.lines) ? run_in_headless_window(options) : run_in_engine(options);
}

}  // namespace dmoscope::app
