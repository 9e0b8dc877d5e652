#pragma once
// Actions of the window: their names, keys and menus, whether they are possible now, and how the palette finds them.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/commands/commands.h"
#include "core/view/view.h"
#include "ui/state/keys.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Condition for an action to be possible.
enum class Needs { Nothing, Mesh, MeshAndIdle, Work, SeveralRuns, Picked, Selected, Undo, Redo, Volume, Planar, Better, Leavable, Chosen };

struct Action {
  std::string_view id;       // "step-iteration"; also the name of its items
  std::string_view menu;     // "Run"
  std::string_view title;    // "Next iteration"
  std::string_view key;      // "N", empty when it has none
  std::string_view command;  // one line of the command language
  Needs needs = Needs::Nothing;
  bool separator = false;    // a line above it in the menu
  std::string_view about{};  // explanation for tooltips, if the title does not tell enough
};

/// All actions, in the order of the menus.
[[nodiscard]] std::span<const Action> actions();
/// The action of this id; null when there is none.
[[nodiscard]] const Action* find_action(std::string_view id);
/// The action of a key; null when it has none.
[[nodiscard]] const Action* action_of(const KeyChord& chord);
/// Menu names in order.
[[nodiscard]] std::vector<std::string_view> menu_names();

/// Facts that decide whether needs are met.
struct Situation {
  bool mesh = false, busy = false, picked = false;
  std::size_t runs = 0;
  bool selected = false;       // at least one vertex is selected; see Selection
  std::string undo{}, redo{};  // title of what they take back or repeat ("run 10"); empty: nothing
  bool volume = false;         // the mesh is one of volume elements
  bool better = false;         // the active run is not at its best iteration
  bool leavable = false;       // the mouse does something else than picking, such as brushing
};
[[nodiscard]] bool enabled(const Action& action, const Situation& situation);
/// The title, for undo and redo with what they are about: "Undo run 10".
[[nodiscard]] std::string title_of(const Action& action, const Situation& situation);

/// Actions whose title, menu or command holds all words of `query` (case-insensitive), best first: titles that begin with it.
[[nodiscard]] std::vector<const Action*> search_actions(std::string_view query);

/// The words of a search, in small letters, and whether a text holds all of them (case-insensitive).
[[nodiscard]] std::vector<std::string> search_words(std::string_view query);
[[nodiscard]] bool holds_all(std::string_view text, std::span<const std::string> words);

[[nodiscard]] Situation situation_of(const SessionView& session, const ViewState& state, bool busy);

struct PaletteEntry {
  std::string title, detail, command;
  bool possible = true;
  bool complete = true;  // false: the command still needs words; choosing it puts it into the line
  std::string name{};    // name of an action, without its menu
};

/// Actions, then commands of the window (`window_commands`) and of the session, that hold all words of `text`; all of them for an empty
/// one. A command with words after it is run as it stands, and comes first, except after an action with exactly that name. Entries that are
/// impossible now come last.
[[nodiscard]] std::vector<PaletteEntry> palette_entries(std::string_view text, const Situation& situation,
                                                        std::span<const CommandInfo> window_commands);

}  // namespace dmoscope::ui
