#pragma once
// The window's commands, theme by theme, and the reading of their words. Only for sources of this module.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/commands/commands.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

[[noreturn]] inline void unexpected(const std::string& word, std::string_view expected) {
  throw UsageError(fmt::format("\"{}\": expected {}", word, expected));
}

/// The shown state of the session. Throws UsageError if no mesh is open.
inline std::shared_ptr<const SessionView> open_view(const CommandHost& host) {
  auto view = host.session();
  if (!view || !view->input) throw UsageError("no mesh is open");
  return view;
}

/// Reads options and one path. `take(word, value)`: sets the option of this word, with its value from value(); false for other words.
template <class Take>
void read_options(Arguments words, std::filesystem::path& path, std::string_view expected, Take take) {
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    const auto value = [&]() -> const std::string& {
      if (++k >= words.size()) throw UsageError(word + ": a value is missing");
      return words[k];
    };
    if (take(word, value)) continue;
    if (!path.empty() || word.starts_with("--")) unexpected(word, expected);
    path = word;
  }
}

/// New state of a switch from the word on, off or toggle (also: no word).
inline bool switched(Arguments words, std::size_t at, bool now) {
  if (words.size() <= at || words[at] == "toggle") return !now;
  if (words[at] == "on") return true;
  if (words[at] == "off") return false;
  unexpected(words[at], "on, off or toggle");
}

/// The value of a name; throws UsageError that lists the names.
template <class Choices>
auto choose(const std::string& word, const Choices& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    if (!names.empty()) names += ", ";
    names += name;
  }
  unexpected(word, "one of " + names);
}

/// Add the window's commands to the table: those that only set an option, see view_options(); visible part and camera of a volume mesh;
/// colours, filter and labels; the window's look as a script gives it again; its files; the mouse and the keyboard; viewports; plots;
/// selected vertices; marks and playing.
void add_option_commands(CommandTable& table, ViewState& state);
void add_clipping_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_colouring_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_desktop_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_file_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_input_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_pane_commands(CommandTable& table, ViewState& state);
void add_plot_commands(CommandTable& table, ViewState& state);
void add_selection_commands(CommandTable& table, ViewState& state, const CommandHost& host);
void add_timeline_commands(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
