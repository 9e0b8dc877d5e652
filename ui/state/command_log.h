#pragma once
// What was done and said since the window opened, and the script that does it again.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/commands/message.h"
#include "core/engine/command_end.h"

namespace dmoscope::ui {

struct LogLine {
  enum class Kind { Command, Info, Warning, Error };
  enum class State { Pending, Done, Failed, Cancelled, Dropped };  // of a command
  Kind kind = Kind::Command;
  std::string text;
  std::string time;  // "14:03:27", by the wall
  State state = State::Done;
};

class CommandLog {
 public:
  static constexpr std::size_t kMostLines = 2000;      // to be read; the oldest go
  static constexpr std::size_t kMostSteps = 100'000;   // of the script; a longer session cannot be saved as one
  static constexpr std::size_t kLongestText = 10'000;  // characters of a line to be read

  /// Around every command line of a person or a script. `look`: see view_lines. What has changed of it since the last command, by the
  /// mouse, is noted first.
  void begin(std::string_view line, const std::vector<std::string>& look);
  /// The command was refused; what it said.
  void refuse(std::string_view what);
  /// The command (or the window itself: playback) asked the session for this line, as number `id`.
  void posted(std::string_view line, std::uint64_t id);
  /// `look`: as the command left it.
  void end(const std::vector<std::string>& look);
  /// The look is as a command that was noted brought it about, some frames later.
  void keep_look(const std::vector<std::string>& look) { look_ = look; }
  void ended(const CommandEnd& end);
  /// What was posted as number `id`, while it has not ended; else empty.
  [[nodiscard]] std::string_view line_of(std::uint64_t id) const;
  void say(const Message& message);

  [[nodiscard]] const std::deque<LogLine>& lines() const noexcept { return lines_; }
  /// Commands that bring a fresh window to the same mesh and the same picture: what the mouse did to the view as commands, a cancelled
  /// command as the moment it came to; what failed, and what does not matter for that (opening a dialog), as comments or not at all.
  /// `look`: as it is now. Throws UsageError when the session was too long.
  [[nodiscard]] std::string script(const std::vector<std::string>& look) const;

 private:
  struct Step {
    std::string line;
    std::uint64_t id = 0;             // of the session's command, 0: none
    std::vector<std::string> resume;  // what leads to the moment it came to; empty where the line itself does
    std::string why_not{};            // it is not to be done again, because
    std::size_t shown_as = 0;         // number of its line in the list to be read
    bool ended = false;
  };
  void show(LogLine line);
  void add_step(Step step);
  void note_changes(const std::vector<std::string>& look);
  [[nodiscard]] LogLine* shown(const Step& step);

  std::deque<LogLine> lines_;
  std::size_t dropped_ = 0;  // lines that went
  std::vector<Step> steps_;
  std::vector<std::string> look_, first_look_;
  bool begun_ = false, overflown_ = false, noting_ = false;
  std::string current_;             // the command's line at work, not yet noted when empty
  std::size_t oldest_pending_ = 0;  // steps before it have ended
};

/// What a line is to a record: an action; one that is told but not repeated (what it brings about is noted itself); a short word for
/// what it asks the session, which is noted instead; or nothing worth a line (dialogs, simulated input).
enum class Record { Action, ToldOnly, Shortcut, Nothing };
[[nodiscard]] Record record_of(std::string_view command);

/// Whether a line holds all words of a filter (case-insensitive).
[[nodiscard]] bool matches(const LogLine& line, std::string_view filter);

}  // namespace dmoscope::ui
