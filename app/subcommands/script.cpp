// dmoscope script: runs a file of commands, with or without the window.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <istream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "app/common/memory_limit.h"
#include "app/common/run_options.h"
#include "app/comparison/of_session.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/commands/session_commands.h"
#include "core/engine/engine.h"
#include "core/io/reading/source_file.h"
#include "core/session/read_files.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/script.h"
#endif

namespace dmoscope::app {
namespace {

struct ScriptSubcommandOptions {
  std::string file;
  std::string backend = "auto";
  bool headless = false;
  MemoryLimit memory;
};

constexpr std::size_t kMostScript = std::size_t{1} << 26U;

/// Reads a whole stream. Throws InputError beyond kMostScript bytes, since a pipe may never end.
std::string text_of(std::istream& stream, const std::string& name) {
  std::string text;
  for (std::array<char, 65536> part{}; stream.read(part.data(), part.size()), stream.gcount() > 0;) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMostScript) throw InputError(name, 0, fmt::format("too large: at most {} bytes are read of a script", kMostScript));
  }
  return text;
}

std::vector<std::string> read_lines(const std::string& file) {
  std::error_code unknown;
  std::string text;
  if (file == "-") {
    text = text_of(std::cin, "standard input");
  } else if (std::filesystem::is_fifo(file, unknown)) {  // such as a shell's <(...)
    std::ifstream stream(file);
    text = text_of(stream, file);
  } else {
    text = read_small_text(file, kMostScript);
  }
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(std::move(line));
  return lines;
}

/// The first command of `lines` that the session does not know, with its line; 0 if it knows them all.
struct Foreign {
  std::size_t line = 0;
  std::string command;
};
Foreign first_foreign(const std::string& name, const std::vector<std::string>& lines) {
  const auto& known = session_commands();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<std::string> words;
    try {
      words = split_words(lines[i]);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}:{}: {}", name, i + 1, error.what()));
    }
    if (words.empty()) continue;
    const auto matches = [&words](const CommandInfo& command) { return command.name == words.front(); };
    if (std::none_of(known.begin(), known.end(), matches)) return {i + 1, words.front()};
  }
  return {};
}

/// Prints the engine's messages; returns the exit code of the first that is an error or a cancel, else 0.
int tell(const std::vector<Message>& messages, const std::string& name, std::size_t line) {
  for (const Message& message : messages) {
    if (message.kind == Message::Kind::Error || message.exit_code != 0) {
      complain(fmt::format("{}:{}: {}", name, line, message.text));
      return message.exit_code == 0 ? 3 : message.exit_code;
    }
    if (message.kind == Message::Kind::Warning) {
      complain(message.text);
    } else {
      print("{}\n", message.text);
      flush_output();
    }
  }
  return 0;
}

int run_on_session(const std::string& name, const std::vector<std::string>& lines, const ScriptSubcommandOptions& options) {
  const Backend backend = parse_backend(options.backend);
  block_interrupts();  // before the engine's threads start
  Engine engine(0, acceleration_for(backend), backend);
  engine.set_report_writer(write_report_of_session);
  engine.rest_without_long_work();  // otherwise each line would wait for work that no command asked for
  // Ctrl+C may also come between two lines, when the engine has nothing to cancel.
  std::atomic<bool> interrupted{false};
  const Watch watch(engine.progress(), [&engine, &interrupted] {
    interrupted = true;
    engine.cancel();
  });
  if (options.memory.bytes() != 0) engine.post(fmt::format("max-memory {}", options.memory.bytes()));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    engine.post(lines[i]);
    if (interrupted) engine.cancel();
    engine.wait_idle();
    if (const int code = tell(engine.take_messages(), name, i + 1); code != 0) return code;
    if (interrupted) {
      complain(fmt::format("{}:{}: cancelled", name, i + 1));
      return Cancelled().exit_code();
    }
  }
  return 0;
}

/// Throws UsageError before the first line runs if a command would overwrite a file that is still needed.
void refuse_overwriting(const ScriptSubcommandOptions& options, const std::string& name, const std::vector<std::string>& lines) {
  const Overwriting found = first_overwriting(options.file == "-" ? "" : options.file, lines);
  if (found.line != 0) throw UsageError(fmt::format("{}:{}: {}", name, found.line, found.what));
}

int script(const ScriptSubcommandOptions& options) {
  const std::string name = options.file == "-" ? "standard input" : options.file;
  const std::vector<std::string> lines = read_lines(options.file);
  refuse_overwriting(options, name, lines);
  const Foreign foreign = first_foreign(name, lines);
  if (foreign.line == 0) return run_on_session(name, lines, options);
#ifdef DMOSCOPE_HAVE_GUI
  ScriptOptions window;
  window.name = name;
  window.lines = lines;
  window.headless = options.headless;
  window.backend = parse_backend(options.backend);
  window.most_memory = options.memory.bytes();
  window.report = write_report_of_session;
  return run_script(window);
#else
  throw UsageError(fmt::format("{}:{}: unknown command '{}' (this program was built without the window and its commands)", name,
                               foreign.line, foreign.command));
#endif
}

}  // namespace

void add_script(CLI::App& app, Action& action) {
  auto options = std::make_shared<ScriptSubcommandOptions>();
  CLI::App* subcommand = app.add_subcommand(
      "script", "Run a file of commands, which the manual page and the palette (Ctrl+P) list; stops at the first that fails");
  subcommand->add_option("FILE", options->file, "Script to run; - reads standard input")->required();
  subcommand->add_flag("--headless", options->headless, "Draw without a screen; a script that only computes needs none anyway");
  add_backend_option(*subcommand, options->backend);
  add_memory_option(*subcommand, options->memory);
  subcommand->callback(
      [options, &action] { action = [options] { return within_memory(options->memory, {}, [options] { return script(*options); }); }; });
}

}  // namespace dmoscope::app
