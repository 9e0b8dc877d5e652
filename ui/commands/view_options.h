#pragma once
// The options of the view that are one of several words, in one table: commands, the menu's ticks, saved views, settings and scripts go by
// it.

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/commands/commands.h"
#include "ui/state/actions.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

struct ViewOption {
  std::string_view command;               // with which a script sets it: "wireframe", "panel left"
  std::string_view doc{};                 // of that command; empty: it does more than to set the option, and is written out elsewhere
  std::string_view member{};              // of a saved view: "/colours/by"; empty: none
  std::string_view setting{};             // of the settings: "/panels/left"; empty: none
  bool is_flag = false;                   // saved as true or false
  std::vector<std::string_view> words{};  // by value: "off" and "on", or others
  std::function<std::size_t(const ViewState&)> get{};          // the value: the place of its word
  std::function<void(ViewState&, std::size_t)> set = nullptr;  // null: only the command sets it

  /// As it is saved. `take` returns false, and changes nothing, where `saved` is no such value.
  [[nodiscard]] nlohmann::json saved(const ViewState& state) const;
  [[nodiscard]] bool take(const nlohmann::json& saved, ViewState& state) const;
  /// "true or false", "one of dark, light"
  [[nodiscard]] std::string expected() const;
};
[[nodiscard]] const std::vector<ViewOption>& view_options();

/// Adds the commands that do nothing but set these options.
void add_option_commands(CommandTable& table, ViewState& state, std::initializer_list<std::string_view> commands);
/// "wireframe on": sets the option of that command to what it is now.
[[nodiscard]] std::string option_line(const ViewState& state, std::string_view command);
/// Whether what the action's command asks for is so now: it has a mark in the menu.
[[nodiscard]] bool is_ticked(const ViewState& state, const Action& action);

}  // namespace dmoscope::ui
