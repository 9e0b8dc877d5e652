#include <algorithm>
#include <map>

#include "core/base/unknown_value.h"
#include "ui/commands/command_words.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

using Kind = ViewOption::Kind;

/// Usage of an option: "[on|off|toggle]", "dark|light|contrast|next", "N|off|toggle".
std::string usage_of(const ViewOption& option) {
  if (option.kind() == Kind::Flag) return "[on|off|toggle]";
  std::string usage;
  const auto add = [&usage](std::string_view word) { usage.append(usage.empty() ? "" : "|").append(word); };
  if (option.kind() == Kind::Choice) {
    for (const OptionChoice& choice : option.at.choices) add(choice.word);
    add(option.turn_word());
    return option.entries.toggles ? usage + " [toggle]" : usage;
  }
  const OptionNumber& number = option.at.number;
  add(number.unit);
  if (!number.rest_word.empty()) add(number.rest_word);
  if (number.factor > 0.0) add("up|down");
  if (number.step > 0.0) add("more|less");
  if (number.usual > 0.0) add("toggle");
  return usage;
}

double choice_of(const ViewOption& option, const ViewState& state, double now, Arguments words) {
  const double count = static_cast<double>(option.at.choices.size());
  if (words[0] == "next") {
    do now = now + 1.0 < count ? now + 1.0 : 0.0;
    while (!option.at.is_offered(state, now));
    return now;
  }
  if (words[0] == "toggle") return now == 0.0 ? 1.0 : 0.0;
  const double wanted = option.value_of(words[0]);
  if (wanted < 0.0) {
    std::vector<std::string_view> known;
    for (const OptionChoice& choice : option.at.choices) known.push_back(choice.word);
    const auto guess = closest_word(words[0], known);
    unexpected(words[0], option.expected() + (guess ? fmt::format("; did you mean {}?", *guess) : ""));
  }
  if (words.size() == 1) return wanted;
  if (words[1] != "toggle") unexpected(words[1], "toggle");
  return wanted == now ? 0.0 : wanted;
}

double number_of(const ViewOption& option, double now, const std::string& word) {
  const OptionNumber& number = option.at.number;
  if (word == "default") return option.at.get({});
  if (!number.rest_word.empty() && word == number.rest_word) return number.rest;
  if (word == "toggle" && number.usual > 0.0) return now == number.rest ? number.usual : number.rest;
  double wanted = 0.0;
  if (number.factor > 0.0 && (word == "up" || word == "down")) {
    const double from = now == number.rest ? 1.0 : now;
    wanted = word == "up" ? from * number.factor : from / number.factor;
  } else if (number.step > 0.0 && (word == "more" || word == "less")) {
    wanted = word == "more" ? now + number.step : now - number.step;
  } else {
    wanted = number.whole ? static_cast<double>(to_count(word)) : to_number(word);
    if (number.factor > 0.0 && !(wanted > 0.0)) unexpected(word, "a number greater than 0");
  }
  if (number.clamped) return std::clamp(wanted, number.least, number.most);
  const bool rests = wanted == number.rest && number.rest_word.empty();  // otherwise only the word means none
  if (!rests && !(wanted >= number.least && wanted <= number.most)) unexpected(word, option.expected());
  return wanted;
}

void set_option(ViewState& state, const ViewOption& option, Arguments words) {
  const double now = option.now(state);
  const double wanted = option.kind() == Kind::Flag     ? (switched(words, 0, now != 0.0) ? 1.0 : 0.0)
                        : option.kind() == Kind::Choice ? choice_of(option, state, now, words)
                                                        : number_of(option, now, words[0]);
  (option.at.change != nullptr ? option.at.change : option.at.set)(state, wanted);
  if (option.at.then != nullptr) option.at.then(state);
}

}  // namespace

void add_option_commands(CommandTable& table, ViewState& state) {
  // A command of several options has their names as its first word.
  std::map<std::string_view, std::vector<const ViewOption*>> several;
  for (const ViewOption& option : view_options()) {
    if (option.doc.empty()) continue;
    const std::size_t least = option.kind() == Kind::Flag ? 0 : 1, most = option.kind() == Kind::Choice ? 2 : 1;
    if (const std::size_t blank = option.command.find(' '); blank != std::string_view::npos) {
      several[option.command.substr(0, blank)].push_back(&option);
    } else {
      table.add({std::string(option.command), fmt::format("{} {}", option.command, usage_of(option)), std::string(option.doc)},
                {least, most}, [&state, &option](Arguments words) { set_option(state, option, words); });
    }
  }
  for (const auto& [command, options] : several) {
    std::vector<std::pair<std::string_view, const ViewOption*>> names;
    std::string usage;
    for (const ViewOption* option : options) {
      names.emplace_back(option->command.substr(command.size() + 1), option);
      usage.append(usage.empty() ? "" : "|").append(names.back().first);
    }
    const std::size_t least = options.front()->kind() == Kind::Flag ? 1 : 2;
    table.add(
        {std::string(command), fmt::format("{} {} {}", command, usage, usage_of(*options.front())), std::string(options.front()->doc)},
        {least, 2}, [&state, names](Arguments words) { set_option(state, *choose(words[0], names), words.subspan(1)); });
  }
}

}  // namespace dmoscope::ui
