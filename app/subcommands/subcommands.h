#pragma once
// The subcommands of the command line, one source each. Each declares its options and sets the action that follows parsing.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dmoscope::app {

/// Work of the parsed command line; returns the exit code, throws dmoscope::Error.
using Action = std::function<int()>;

/// Adds the subcommand smooth. `command_line`: for the provenance of results.
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

/// Opens the window on the files, if there is no subcommand. `subcommands`: all names, for a message if there is no screen.
int open_window(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& subcommands);

}  // namespace dmoscope::app
