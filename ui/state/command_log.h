#pragma once
// Log of commands and messages since the window opened, and the script that repeats them.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/commands/commands.h"
#include "core/engine/command_end.h"

namespace dmoscope::ui {

struct LogLine {
  enum class Kind { Command, Info, Warning, Error };
  enum class State { Pending, Done, Failed, Cancelled, Dropped };  // state of a command
  Kind kind = Kind::Command;
  std::string text;
  std::string time;  // wall-clock time: "14:03:27"
  State state = State::Done;
};

class CommandLog {
 public:
  static constexpr std::size_t kMostLines = 2000;      // lines kept for reading; the oldest are removed
  static constexpr std::size_t kMostSteps = 100'000;   // steps kept for the script; a longer session cannot be saved as one
  static constexpr std::size_t kLongestText = 10'000;  // characters of a line for reading

  /// Begins a command line of a person or a script. `look`: see view_lines. Changes of it by the mouse since the last command are noted
  /// first.
  void begin(std::string_view line, const std::vector<std::string>& look);
  /// Ends the command as refused, with the reason `what`.
  void refuse(std::string_view what);
  /// Notes that the command (or the window itself: playback) sent this line to the session, as number `id`.
  void posted(std::string_view line, std::uint64_t id);
  /// Ends the command. `look`: see view_lines, after the command.
  void end(const std::vector<std::string>& look);
  /// Takes over the look that a noted command brought about some frames later.
  void keep_look(const std::vector<std::string>& look) { look_ = look; }
  void ended(const CommandEnd& end);
  /// Line that was posted as number `id`, while it has not ended; else empty.
  [[nodiscard]] std::string_view line_of(std::uint64_t id) const;
  void say(const Message& message);

  [[nodiscard]] const std::deque<LogLine>& lines() const noexcept { return lines_; }
  /// Commands that bring a fresh window to the same mesh and the same picture: the mouse's changes of the view are written as commands, a
  /// cancelled command as the moment it reached; failed commands, and those without effect on mesh and picture (opening a dialog), are
  /// comments or left out. `look`: see view_lines, now. Throws UsageError when the session was too long.
  [[nodiscard]] std::string script(const std::vector<std::string>& look) const;

 private:
  struct Step {
    std::string line;
    std::uint64_t id = 0;             // number of the session's command; 0: none
    std::vector<std::string> resume;  // commands that lead to the moment it reached; empty when the line itself does
    std::string why_not{};            // reason why it must not be repeated
    std::size_t shown_as = 0;         // number of its line in the list to be read
    bool ended = false;
  };
  void show(LogLine line);
  void add_step(Step step);
  void note_changes(const std::vector<std::string>& look);
  [[nodiscard]] LogLine* shown(const Step& step);

  std::deque<LogLine> lines_;
  std::size_t dropped_ = 0;  // lines that were removed
  std::vector<Step> steps_;
  std::vector<std::string> look_, first_look_;
  bool begun_ = false, overflown_ = false, noting_ = false;
  std::string current_;             // line of the command at work; empty once it is noted
  std::size_t oldest_pending_ = 0;  // all steps before this one have ended
};

/// Way to record a line: as an action; told but not repeated (its effect is noted itself); as a shortcut for the session's line, which is
/// noted instead; or not at all (dialogs, simulated input).
enum class Record { Action, ToldOnly, Shortcut, Nothing };
[[nodiscard]] Record record_of(std::string_view command);

/// Whether a line holds all words of a filter (case-insensitive).
[[nodiscard]] bool matches(const LogLine& line, std::string_view filter);

}  // namespace dmoscope::ui
