#include "core/commands/commands.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/unknown_value.h"

namespace dmoscope {
std::string unknown_command(std::string_view word, std::span<const CommandInfo> known) {
  std::vector<std::string_view> names;
  for (const CommandInfo& command : known) names.push_back(command.name);
  const auto guess = closest_word(word, names);
  return fmt::format("unknown command '{}'{}", word, guess ? fmt::format("; did you mean {}?", *guess) : std::string());
}

void CommandTable::add(CommandInfo info, WordCount words, Handler handler) {
  infos_.push_back(std::move(info));
  handlers_.emplace_back(words, std::move(handler));
}

bool CommandTable::knows(std::string_view name) const { return std::ranges::find(infos_, name, &CommandInfo::name) != infos_.end(); }

void CommandTable::execute(std::string_view line) const {
  const std::vector<std::string> words = split_words(line);
  if (words.empty()) return;
  const auto found = std::ranges::find(infos_, words.front(), &CommandInfo::name);
  if (found == infos_.end()) throw UsageError(unknown_command(words.front(), infos_));
  try {
    const auto& [count, handler] = handlers_[static_cast<std::size_t>(found - infos_.begin())];
    require(Arguments(words).subspan(1), count.least, count.most);
    handler(Arguments(words).subspan(1));
  } catch (const WrongArguments& wrong) {
    throw UsageError(fmt::format("{}; usage: {}", wrong.what(), found->usage));
  }
}

}  // namespace dmoscope
