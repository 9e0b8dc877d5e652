// The program: parses the command line, runs one subcommand, and turns every error into a message and an exit code.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/common/console.h"
#include "app/common/text.h"
#include "app/completion.h"
#include "app/handover.h"
#include "app/man_page.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope::app {
namespace {

constexpr int kWrongUsage = 2;
constexpr int kBadInputOrOutput = 3;

/// Runs the action; an error becomes a message and its exit code.
int guarded(const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    complain(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    complain("not enough memory for this mesh");
    return kBadInputOrOutput;
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) == 0) {
      complain(error.what());
    } else {
      complain(fmt::format("standard output: {}", error.code().message()));
    }
    return kBadInputOrOutput;
  } catch (const std::exception& error) {
    complain(fmt::format("unexpected error (please report it): {}", error.what()));
    return kBadInputOrOutput;
  }
}

/// Prints --help or --version, with which the parser ends.
int print_requested(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream text;
  app.exit(error, text, text);
  print_lines(text.str());
  return 0;
}

/// Words that no option takes, as they were given, with the option that the first of them may have been meant to be.
std::string not_expected(const CLI::App& app, std::span<char* const> arguments) {
  const std::vector<std::string> left = app.remaining(true);  // not in their order
  std::vector<std::string> words, names;
  for (const std::string_view argument : arguments)
    if (std::ranges::find(left, argument) != left.end()) words.emplace_back(argument);
  for (const CLI::App* chosen : app.get_subcommands())
    for (const CLI::Option* option : chosen->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const auto guess = words.empty() ? std::nullopt : closest_word(words.front(), std::vector<std::string_view>(names.begin(), names.end()));
  return fmt::format("not expected: {}{}", fmt::join(words, " "), guess ? fmt::format("; did you mean {}?", *guess) : std::string());
}

int run(int argc, char** argv) {
  CLI::App app("See, compare and run Discrete Mesh Optimization: smooth a mesh so that its worst element gets as good as it can.",
               "dmoscope");
  app.set_version_flag("--version", std::string("dmoscope ") + DMOSCOPE_VERSION);
  app.require_subcommand(0, 1);

  std::vector<std::filesystem::path> files;
  app.add_option("FILE", files, "Meshes to open in the window");
  bool man = false;
  app.add_flag("--man", man, "Print the man page in roff")->group("");
  std::string shell;
  app.add_option("--completion", shell, "Print a script by which a shell completes: bash or zsh")->group("");

  Action action = [&files, &app] {
    std::vector<std::string> subcommands;
    for (const CLI::App* subcommand : app.get_subcommands({})) subcommands.push_back(subcommand->get_name());
    return open_window(files, subcommands);
  };
  const std::string command_line = shell_line(std::vector<std::string>(argv, argv + argc));
  add_smooth(app, action, command_line);
  add_compare(app, action, command_line);
  add_quality(app, action);
  add_render(app, action);
  add_convert(app, action);
  add_generate(app, action);
  add_script(app, action);
  add_bench(app, action);
  add_paper(app, action, command_line);
  add_formula(app, action);
  add_info(app, action);
  // Added last: subcommands would inherit it.
  app.footer(
      "Without a subcommand the window opens on the files. Exit codes: 0 done; 1 ran but did not reach what was asked; 2 wrong usage; "
      "3 bad input or output.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return guarded([&app, &error] { return print_requested(app, error); });
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    complain(unknown ? not_expected(app, std::span(argv + 1, static_cast<std::size_t>(argc - 1))) : error.what(),
             "Run with --help for more information.");
    return kWrongUsage;
  }
  if (man) {
    action = [&app] {
      print_lines(man_page(app));
      return 0;
    };
  }
  if (!shell.empty()) {
    action = [&app, &shell] {
      print_lines(completion_script(app, shell));
      return 0;
    };
  }
  return guarded(action);
}

}  // namespace
}  // namespace dmoscope::app

int main(int argc, char** argv) {
  try {
    dmoscope::app::ignore_file_limit_signal();
    dmoscope::app::hand_over_to_mpi(argv);
    const int code = dmoscope::app::run(argc, argv);
    // A full disk or closed pipe below standard output must not look like success; an error of it was reported already.
    if (code != dmoscope::app::kBadInputOrOutput) dmoscope::app::flush_output();
    return code;
  } catch (const dmoscope::Error& error) {
    dmoscope::app::complain(error.what());
    return error.exit_code();
  } catch (const std::exception& error) {
    dmoscope::app::complain(error.what());
    return 3;
  }
}
