#include "ui/state/view_options.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dmoscope::ui {
namespace {

/// Value of a number from a file: one below `least` means none, as in older files.
double from_file(const OptionNumber& number, double value) { return value < number.least && value >= number.rest ? number.rest : value; }

}  // namespace

const std::vector<ViewOption>& view_options() {
  static const std::vector<ViewOption> table = all_view_options();
  return table;
}

const ViewOption& view_option(std::string_view command) { return *std::ranges::find(view_options(), command, &ViewOption::command); }

ViewOption::Kind ViewOption::kind() const { return !at.choices.empty() ? Kind::Choice : at.is_flag ? Kind::Flag : Kind::Number; }

std::string ViewOption::word(double value) const {
  if (kind() == Kind::Choice) return std::string(at.choices[static_cast<std::size_t>(value)].word);
  if (kind() == Kind::Flag) return value != 0.0 ? "on" : "off";
  return value == at.number.rest && !at.number.rest_word.empty() ? std::string(at.number.rest_word) : fmt::format("{}", value);
}

double ViewOption::value_of(std::string_view choice) const {
  const auto found = std::ranges::find(at.choices, choice, &OptionChoice::word);
  return found == at.choices.end() ? -1.0 : static_cast<double>(found - at.choices.begin());
}

nlohmann::json ViewOption::saved(const ViewState& state) const {
  const double value = at.get(state);
  if (at.is_flag) return value != 0.0;
  if (kind() == Kind::Choice) return word(value);
  return at.number.whole ? nlohmann::json(static_cast<std::uint64_t>(value)) : nlohmann::json(value);
}

bool ViewOption::take(const nlohmann::json& saved, ViewState& state) const {
  double value = -1.0;
  if (kind() == Kind::Number) {
    if (!(at.number.whole ? saved.is_number_unsigned() : saved.is_number())) return false;
    value = from_file(at.number, saved.get<double>());
    if (!(value == at.number.rest || (value >= at.number.least && value <= at.number.most))) return false;
  } else if (at.is_flag) {
    if (!saved.is_boolean()) return false;
    value = saved.get<bool>() ? 1.0 : 0.0;
  } else {
    value = saved.is_string() ? value_of(saved.get<std::string>()) : -1.0;
    if (value < 0.0 || value >= static_cast<double>(kept.lasting)) return false;
  }
  at.set(state, value);
  return true;
}

std::string ViewOption::expected(bool in_file) const {
  if (at.is_flag && in_file) return "true or false";
  if (kind() == Kind::Number) {
    const auto& [least, most, whole, clamped, unit, rest, rest_word, usual, step, factor] = at.number;
    const std::string none = in_file || rest_word.empty() ? fmt::format("{}", rest) : std::string(rest_word);
    return fmt::format("{}a {}number from {} to {}", rest < least || rest > most ? none + ", or " : "", whole ? "whole " : "", least, most);
  }
  std::string words;
  for (const OptionChoice& choice : at.choices) words += (words.empty() ? "one of " : ", ") + std::string(choice.word);
  return words;
}

std::string_view ViewOption::turn_word() const { return !entry.turn.empty() ? entry.turn : at.choices.size() > 2 ? "next" : "toggle"; }

std::string option_line(const ViewState& state, std::string_view command) {
  const ViewOption& option = view_option(command);
  return fmt::format("{} {}", command, option.word(option.at.get(state)));
}

bool is_ticked(const ViewState& state, const Action& action) {
  if (action.needs == Needs::Volume && !state.in_space) return false;
  const auto option = std::ranges::find_if(view_options(), [&](const ViewOption& one) {
    return action.command == one.command || action.command.starts_with(std::string(one.command) + ' ');
  });
  if (option == view_options().end()) return false;
  const std::string_view words = action.command.substr(std::min(option->command.size() + 1, action.command.size()));
  const std::string_view word = words.substr(0, words.find(' '));
  const double now = option->now(state);
  const bool switches = word.empty() || word == "toggle";
  if (option->kind() == ViewOption::Kind::Number) return switches ? now != option->at.number.rest : word == option->word(now);
  return switches ? now != 0.0 : option->word(now) == word;
}

std::uint64_t options_key(const ViewState& state) {
  std::uint64_t key = 14695981039346656037U;  // Fowler, Noll and Vo's hash
  for (const ViewOption& option : view_options()) key = (key ^ std::hash<double>{}(option.at.get(state))) * 1099511628211U;
  return key;
}

}  // namespace dmoscope::ui
