#pragma once
// Options of the view, a row each. Saved views, settings, scripts, commands, menus with their ticks and keys, the palette and boxes of
// panels go by these rows, so that a new option is a row here and what draws by it.

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

/// One value of an option that is one of several words; its place in the list is the value.
struct OptionChoice {
  std::string_view word, title{}, doc{};
  std::string_view entry{};  // its title in the menu, where that is another one
  std::string_view key{};
  std::string_view id{};  // of its action; empty: "COMMAND-WORD"
};

/// What numbers an option takes.
struct OptionNumber {
  double least = 0.0, most = 1.0;
  bool whole = false;
  bool clamped = false;          // a command's number beyond these is brought between them, instead of refused
  std::string_view unit = "N";   // in the command's usage
  double rest = NAN;             // stands for "none", also where it lies beyond least and most; NaN: there is none
  std::string_view rest_word{};  // for a command: "off"; "default" takes any option back to that of a new window
  double usual = 0.0;            // to which "toggle" goes from `rest`; 0: it cannot be toggled
  double step = 0.0;             // of "more" and "less"; 0: none
  double factor = 0.0;           // of "up" and "down"; 0: none
};

/// An option's place in the state, and what may be there: 0 or 1, the place of a word among the choices, or a number.
struct OptionValue {
  double (*get)(const ViewState&) = nullptr;
  void (*set)(ViewState&, double) = nullptr;  // null: only the command sets it
  bool is_flag = false;                       // saved as true or false
  std::vector<OptionChoice> choices{};
  OptionNumber number{};
  void (*change)(ViewState&, double) = nullptr;        // what its command does, where that is not `set`; may throw UsageError
  void (*then)(ViewState&) = nullptr;                  // what its command does besides
  double (*seen)(const ViewState&) = nullptr;          // what a person sees it as, where that is not `get`
  bool (*offers)(const ViewState&, double) = nullptr;  // which values there are now; null: all

  [[nodiscard]] OptionValue changed_by(void (*own)(ViewState&, double)) && { return change = own, std::move(*this); }
  [[nodiscard]] OptionValue and_then(void (*own)(ViewState&)) && { return then = own, std::move(*this); }
  [[nodiscard]] OptionValue seen_as(double (*own)(const ViewState&)) && { return seen = own, std::move(*this); }
  [[nodiscard]] OptionValue offered_if(bool (*own)(const ViewState&, double)) && { return offers = own, std::move(*this); }
  [[nodiscard]] bool is_offered(const ViewState& state, double value) const { return offers == nullptr || offers(state, value); }
};

/// Where an option is kept: its member of a saved view ("/colours/by"), its place in the settings ("/panels/left"), both empty where there
/// is none; whether scripts that are saved set it; and how many of its choices are saved, as what others need does not last.
struct OptionKeeping {
  std::string_view member{}, setting{};
  bool in_scripts = false;
  std::size_t lasting = 99;
};
/// Its own action, which switches it, or goes to its next value: below the action `after`; empty: it has none.
struct OptionEntry {
  std::string_view title{}, after{}, key{};
  std::string_view id{};         // empty: the command
  Needs needs = Needs::Nothing;  // Volume, Planar: the option is for such meshes alone
  bool apart = false;            // below a line
  std::string_view menu{};       // empty: that of `after`
  std::string_view turn{};       // the command's word; empty: "toggle", or "next"
};
/// An action "TITLE: CHOICE" for every choice that has a title; `toggles`: chosen again, it goes back to the first choice.
struct OptionEntries {
  std::string_view after{}, title{};
  bool apart = false, toggles = false;
  std::string_view menu{};
};
/// In panels: its label, and the part of a panel that lists it, see option_rows(); empty: a panel draws it by itself, or none does.
struct OptionBox {
  std::string_view label{}, panel{};
};

struct ViewOption {
  enum class Kind : std::uint8_t { Flag, Choice, Number };

  std::string_view command{};  // with which it is set: "wireframe", "panel left"; empty: none
  std::string_view doc{};      // of command and box; empty: the command does more than to set it, and is written out elsewhere
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
  /// As it is saved. `take` returns false, and changes nothing, where `saved` is no such value.
  [[nodiscard]] nlohmann::json saved(const ViewState& state) const;
  [[nodiscard]] bool take(const nlohmann::json& saved, ViewState& state) const;
  /// "one of dark, light", "a number from 0 to 1"; in a file also "true or false".
  [[nodiscard]] std::string expected(bool in_file = false) const;
  /// As a command says it: "on", "dark", "0.8".
  [[nodiscard]] std::string word(double value) const;
  /// The place of a word among the choices; none: -1.
  [[nodiscard]] double value_of(std::string_view choice) const;
  /// The word of its action: "toggle".
  [[nodiscard]] std::string_view turn_word() const;
};

[[nodiscard]] const std::vector<ViewOption>& view_options();
/// The option of a command. It must be there.
[[nodiscard]] const ViewOption& view_option(std::string_view command);

/// "wireframe on": sets the option of that command to what it is now.
[[nodiscard]] std::string option_line(const ViewState& state, std::string_view command);
/// Whether what the action's command asks for is so now: it has a mark in the menu.
[[nodiscard]] bool is_ticked(const ViewState& state, const Action& action);
/// Changes when an option does: what is drawn by options must be drawn again.
[[nodiscard]] std::uint64_t options_key(const ViewState& state);

// The rows, by theme.
[[nodiscard]] std::vector<ViewOption> mark_options();
[[nodiscard]] std::vector<ViewOption> inside_options();
[[nodiscard]] std::vector<ViewOption> colour_options();
[[nodiscard]] std::vector<ViewOption> stepping_options();
[[nodiscard]] std::vector<ViewOption> inspection_options();
[[nodiscard]] std::vector<ViewOption> plot_options();
[[nodiscard]] std::vector<ViewOption> panel_options();
[[nodiscard]] std::vector<ViewOption> desktop_options();

}  // namespace dmoscope::ui
