#pragma once
// The command language: one table of verbs behind every button, key, palette entry, script line and test.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace dmoscope {

/// Words of one command line. Words are split at blanks; "double quotes" keep blanks, \" and \\ inside them; # starts a comment.
/// Throws UsageError for an open quote.
[[nodiscard]] std::vector<std::string> split_words(std::string_view line);
/// Quotes a word where split_words would need it.
[[nodiscard]] std::string quote_word(std::string_view word);

/// Wrong number or form of a verb's arguments; CommandTable::execute adds the verb's usage.
class WrongArguments : public UsageError {
 public:
  using UsageError::UsageError;
};

struct CommandInfo {
  std::string name;   // first word, "step"
  std::string usage;  // "step vertex|class|iteration [COUNT]"
  std::string doc;    // one line
};

/// Verbs and what they do. Each room that has verbs fills in its own table.
class CommandTable {
 public:
  using Arguments = std::span<const std::string>;  // words after the verb
  using Handler = std::function<void(Arguments)>;
  void add(CommandInfo info, Handler handler);
  [[nodiscard]] const std::vector<CommandInfo>& commands() const noexcept { return infos_; }
  [[nodiscard]] bool knows(std::string_view name) const;
  /// Runs one line; an empty one (or a comment) does nothing. Throws UsageError for an unknown verb or wrong arguments
  /// (with the verb's usage), and whatever the handler throws.
  void execute(std::string_view line) const;

 private:
  std::vector<CommandInfo> infos_;
  std::vector<Handler> handlers_;
};

/// Typed access to words; all throw WrongArguments naming the word and what was expected.
[[nodiscard]] std::uint64_t to_count(const std::string& word, std::uint64_t least = 0);
[[nodiscard]] double to_number(const std::string& word);

}  // namespace dmoscope
