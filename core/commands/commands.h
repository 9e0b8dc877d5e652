#pragma once
// The command language: one table of commands behind every button, key, palette entry, script line and test.

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/words.h"

namespace dmoscope {

// Lines of the session's log.

struct Message {
  enum class Kind { Info, Warning, Error };
  Kind kind = Kind::Info;
  std::string text;
  int exit_code = 0;  // exit code of an Error
};

struct CommandInfo {
  std::string name;   // first word, "step"
  std::string usage;  // usage, such as "step vertex|class|iteration [COUNT]"
  std::string doc;    // description in one line
};

/// Message "unknown command 'stpe'; did you mean step?": there are too many to list; the help lists them.
[[nodiscard]] std::string unknown_command(std::string_view word, std::span<const CommandInfo> known);

inline constexpr std::size_t kAnyWords = std::numeric_limits<std::size_t>::max();
/// Range for the number of words after a command's name.
struct WordCount {
  std::size_t least = 0, most = kAnyWords;
};

/// Commands and their handlers. Each module that has commands fills its own table.
class CommandTable {
 public:
  using Handler = std::function<void(Arguments)>;
  void add(CommandInfo info, WordCount words, Handler handler);
  void add(CommandInfo info, Handler handler) { add(std::move(info), {}, std::move(handler)); }
  [[nodiscard]] const std::vector<CommandInfo>& commands() const noexcept { return infos_; }
  [[nodiscard]] bool knows(std::string_view name) const;
  /// Runs one line; an empty one (or a comment) does nothing. Throws UsageError for an unknown command or wrong arguments
  /// (with the command's usage), and whatever the handler throws.
  void execute(std::string_view line) const;

 private:
  std::vector<CommandInfo> infos_;
  std::vector<std::pair<WordCount, Handler>> handlers_;  // word counts and handlers of infos_
};

}  // namespace dmoscope
