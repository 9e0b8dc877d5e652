// Handles keys that are commands.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/app.h"
#include "ui/state/situation.h"

namespace dmoscope::ui {
namespace {

/// Whether holding the key repeats the action. Switching something, or opening something, is done once.
bool goes_on_while_held(const Action& action) {
  constexpr std::array kSmallSteps{"step ", "back ",  "timeline ", "zoom ", "speed ",    "brush-radius ", "arrow-scale ",
                                   "peel ", "scale ", "undo",      "redo",  "each step", "each back"};
  return std::ranges::any_of(kSmallSteps, [&](std::string_view begin) { return action.command.starts_with(begin); });
}

bool is_step(std::string_view command) { return command.starts_with("step ") || command.starts_with("back "); }

}  // namespace

/// False also while the desktop's dialog is open: keys typed before it is seen are meant for it.
bool App::takes_commands() const {
  return !widgets_.chooser.open && !ImGui::GetIO().WantTextInput && state_.dialog == Dialog::None &&
         !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

/// Whether an action waits: steps that are asked for faster than they are made are all made.
bool App::waits_its_turn(const Action& action) const {
  constexpr std::size_t kMost = 16;
  return is_step(action.command) && engine_.busy() && is_step(engine_.current_command()) && engine_.pending() < kMost;
}

void App::press(const KeyChord& chord, bool repeated) {
  constexpr int kKeypadMinus = 333, kKeypadPlus = 334;
  KeyChord known = chord;
  if (chord.code == kKeypadMinus) known.code = '-';
  if (chord.code == kKeypadPlus) known.code = '+';
  if (known.code == '+' && !known.ctrl && !known.alt) known.shift = false;  // "+" is on Shift on some keyboards
  const Action* action = action_of(known);
  if (action == nullptr || (repeated && !goes_on_while_held(*action))) return;
  Situation now = situation_of(*session_, state_, activity_.busy);
  if (!repeated && waits_its_turn(*action)) now.busy = false;
  if (!enabled(*action, now)) return;
  const std::size_t over = widgets_.run_list.over;  // with the mouse on a run, its key is for that run
  submit_by_person(action->key == "F2" && over > 0 ? fmt::format("begin-rename {}", over) : std::string(action->command));
}

}  // namespace dmoscope::ui
