#pragma once
// Helpers for writing rows of the table of options. Only for their sources.

#include <type_traits>
#include <utility>

#include "ui/state/view_options.h"

namespace dmoscope::ui::option_rows {

using enum Needs;
inline constexpr bool kScript = true, kApart = true;

/// Follows pointers to members: at<&ViewState::stepping, &SteppingState::next_class>().
template <auto... Path>
OptionValue at() {
  using Value = std::remove_cvref_t<decltype((std::declval<ViewState&>().*....*Path))>;
  using Step = std::conditional_t<std::is_enum_v<Value>, int, double>;  // type that turns a number into an enumerator
  return {[](const ViewState& state) { return static_cast<double>((state.*....*Path)); },
          [](ViewState& state, double value) {
            if constexpr (std::is_same_v<Value, bool>) {
              (state.*....*Path) = value != 0.0;
            } else {
              (state.*....*Path) = static_cast<Value>(static_cast<Step>(value));
            }
          },
          std::is_same_v<Value, bool>};
}

inline OptionValue words(OptionValue of, std::vector<OptionChoice> choices) { return of.choices = std::move(choices), of; }
template <class... Choice>
OptionValue words(OptionValue of, const OptionChoice& first, const Choice&... others) {
  return words(std::move(of), std::vector<OptionChoice>{first, others...});
}
inline OptionValue numbers(OptionValue of, const OptionNumber& number) { return of.number = number, of; }

/// One choice of an option: word, title, explanation; then title in the menu, key and id of its action, if they differ.
constexpr OptionChoice choice(std::string_view word, std::string_view title = {}, std::string_view doc = {}, std::string_view entry = {},
                              std::string_view key = {}, std::string_view id = {}) {
  return {word, title, doc, entry, key, id};
}
/// One row: command, explanation, value, and the groups of ViewOption in their order.
inline ViewOption row(std::string_view command, std::string_view doc, OptionValue at, const OptionKeeping& kept = {},
                      const OptionEntry& entry = {}, const OptionEntries& entries = {}, const OptionBox& box = {}) {
  return {command, doc, std::move(at), kept, entry, entries, box};
}
/// Keeps an option under one name in both saved views and settings.
constexpr OptionKeeping both(std::string_view path, bool in_scripts = false) { return {path, path, in_scripts}; }
/// An entry that exists only for its tick.
template <class... Choice>
ViewOption ticked(std::string_view command, double (*get)(const ViewState&), const Choice&... choices) {
  return row(command, {}, {get, nullptr, true, {choices...}});
}

}  // namespace dmoscope::ui::option_rows
