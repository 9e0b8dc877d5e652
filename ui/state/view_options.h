#pragma once
// Options of the view, a row each. Saved views, settings, scripts, commands, menus with their ticks and keys, the palette and boxes of
// panels go by these rows, so that a new option needs only a row here and the code that draws by it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "ui/state/actions.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// One word of an option that has several; its place in the list is the value.
struct OptionChoice {
  std::string_view word, title{}, doc{};
  std::string_view entry{};  // title in the menu, if different
  std::string_view key{};
  std::string_view id{};  // id of its action; empty: "COMMAND-WORD"
};

/// Numbers that an option takes.
struct OptionNumber {
  double least = 0.0, most = 1.0;
  bool whole = false;
  bool clamped = false;          // a command's number beyond these is brought between them, instead of refused
  std::string_view unit = "N";   // in the command's usage
  double rest = NAN;             // number for "none", which may be outside of least and most; NaN: there is none
  std::string_view rest_word{};  // word for "none" in a command: "off"; "default" takes any option back to that of a new window
  double usual = 0.0;            // value to which "toggle" goes from `rest`; 0: it cannot be toggled
  double step = 0.0;             // step of "more" and "less"; 0: none
  double factor = 0.0;           // factor of "up" and "down"; 0: none
};

/// An option's place in the state, and its values: 0 or 1, the index of a word among the choices, or a number.
struct OptionValue {
  double (*get)(const ViewState&) = nullptr;
  void (*set)(ViewState&, double) = nullptr;  // null: only the command sets it
  bool is_flag = false;                       // saved as true or false
  std::vector<OptionChoice> choices{};
  OptionNumber number{};
  void (*change)(ViewState&, double) = nullptr;        // effect of its command, if other than `set`; may throw UsageError
  void (*then)(ViewState&) = nullptr;                  // further effect of its command
  double (*seen)(const ViewState&) = nullptr;          // value as a person sees it, if other than `get`
  bool (*offers)(const ViewState&, double) = nullptr;  // whether a value is possible now; null: all are

  [[nodiscard]] OptionValue changed_by(void (*own)(ViewState&, double)) && { return change = own, std::move(*this); }
  [[nodiscard]] OptionValue and_then(void (*own)(ViewState&)) && { return then = own, std::move(*this); }
  [[nodiscard]] OptionValue seen_as(double (*own)(const ViewState&)) && { return seen = own, std::move(*this); }
  [[nodiscard]] OptionValue offered_if(bool (*own)(const ViewState&, double)) && { return offers = own, std::move(*this); }
  [[nodiscard]] bool is_offered(const ViewState& state, double value) const { return offers == nullptr || offers(state, value); }
};

/// Places where an option is kept: its member of a saved view ("/colours/by"), its place in the settings ("/panels/left"), both empty if
/// there is none; whether saved scripts set it; and how many of its choices are saved (the others depend on things that do not last).
struct OptionKeeping {
  std::string_view member{}, setting{};
  bool in_scripts = false;
  std::size_t lasting = 99;
};
/// An option's action, which switches it or goes to its next value: below the action `after`; empty: it has none.
struct OptionEntry {
  std::string_view title{}, after{}, key{};
  std::string_view id{};         // empty: the command
  Needs needs = Needs::Nothing;  // Volume, Planar: the option is for such meshes only
  bool apart = false;            // below a separator
  std::string_view menu{};       // empty: the menu of `after`
  std::string_view turn{};       // word of the command; empty: "toggle", or "next"
};
/// Actions "TITLE: CHOICE" of an option, one for every choice that has a title; `toggles`: chosen again, it goes back to the first choice.
struct OptionEntries {
  std::string_view after{}, title{};
  bool apart = false, toggles = false;
  std::string_view menu{};
};
/// An option in panels: its label, and the part of a panel that lists it, see option_rows(); empty: a panel draws it by itself, or none
/// does.
struct OptionBox {
  std::string_view label{}, panel{};
};

struct ViewOption {
  enum class Kind : std::uint8_t { Flag, Choice, Number };

  std::string_view command{};  // command that sets it: "wireframe", "panel left"; empty: none
  std::string_view doc{};      // text for command and box; empty: the command does more than set it, and is described elsewhere
  OptionValue at{};
  OptionKeeping kept{};
  OptionEntry entry{};
  OptionEntries entries{};
  OptionBox box{};

  [[nodiscard]] Kind kind() const;
  [[nodiscard]] double now(const ViewState& state) const { return at.seen != nullptr ? at.seen(state) : at.get(state); }
  [[nodiscard]] bool is_saved(const ViewState& state) const {
    return at.choices.empty() || at.get(state) < static_cast<double>(kept.lasting);
  }
  /// Value to be saved. `take` sets it again; it returns false, and changes nothing, if `saved` is no such value.
  [[nodiscard]] nlohmann::json saved(const ViewState& state) const;
  [[nodiscard]] bool take(const nlohmann::json& saved, ViewState& state) const;
  /// Description of the possible values: "one of dark, light", "a number from 0 to 1"; in a file also "true or false".
  [[nodiscard]] std::string expected(bool in_file = false) const;
  /// Word of a value in commands: "on", "dark", "0.8".
  [[nodiscard]] std::string word(double value) const;
  /// Index of a word among the choices; -1: none.
  [[nodiscard]] double value_of(std::string_view choice) const;
  /// Word of its action: "toggle".
  [[nodiscard]] std::string_view turn_word() const;
};

[[nodiscard]] const std::vector<ViewOption>& view_options();
/// The option of a command, which must exist.
[[nodiscard]] const ViewOption& view_option(std::string_view command);

/// Command line that sets the option of that command to its present value: "wireframe on".
[[nodiscard]] std::string option_line(const ViewState& state, std::string_view command);
/// Whether the effect of an action's command is already so: then it has a mark in the menu.
[[nodiscard]] bool is_ticked(const ViewState& state, const Action& action);
/// Hash that changes when an option does: what is drawn by options must then be drawn again.
[[nodiscard]] std::uint64_t options_key(const ViewState& state);

/// Rows of the table, for view_options().
[[nodiscard]] std::vector<ViewOption> all_view_options();

}  // namespace dmoscope::ui
