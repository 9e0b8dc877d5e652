#pragma once
// The subcommands of the command line, one source each. Each declares its options and says what to do once they are parsed.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dmoscope::app {

/// What the parsed command line asks for; returns the exit code, throws dmoscope::Error.
using Action = std::function<int()>;

/// `command_line`: as it was given, for where results come from.
void add_smooth(CLI::App& app, Action& action, const std::string& command_line);
void add_compare(CLI::App& app, Action& action, const std::string& command_line);
void add_quality(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_generate(CLI::App& app, Action& action);
void add_script(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);
void add_paper(CLI::App& app, Action& action, const std::string& command_line);
void add_info(CLI::App& app, Action& action);
void add_formula(CLI::App& app, Action& action);

/// No subcommand: opens the window on the files. `subcommands`: all there are, for whoever has no screen.
int open_window(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& subcommands);

}  // namespace dmoscope::app
