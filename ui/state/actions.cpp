#include "ui/state/actions.h"

#include <algorithm>
#include <array>
#include <deque>

#include <fmt/format.h>

#include "core/commands/session_commands.h"
#include "core/mesh/generate.h"
#include "ui/state/format.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

// Actions that no other table has. Those of samples and of options are rows of their tables: generator_table(), view_options().
constexpr std::array kActions{
    Action{"open", "File", "Open…", "Ctrl+O", "dialog open"},
    Action{"open-beside", "File", "Open beside…", "Ctrl+Shift+O", "dialog open-beside", Needs::Mesh},
    Action{"surface", "File", "Slide on the surface of…", "", "dialog open-surface", Needs::MeshAndIdle},
    Action{"own-surface", "File", "Slide on its own surface", "", "surface own", Needs::MeshAndIdle},
    Action{"export", "File", "Export mesh…", "Ctrl+S", "dialog export", Needs::Mesh},
    Action{"screenshot", "File", "Screenshot…", "Ctrl+Shift+S", "dialog screenshot", Needs::Mesh},
    Action{"save-session", "File", "Save the session…", "", "dialog save-session", Needs::Mesh},
    Action{"sequence", "File", "Pictures of a run…", "", "dialog sequence", Needs::MeshAndIdle},
    Action{"reload", "File", "Read the file again", "F5", "reload", Needs::MeshAndIdle, true},
    Action{"quit", "File", "Quit", "Ctrl+Q", "quit", Needs::Nothing, true},

    Action{"undo", "Edit", "Undo", "Ctrl+Z", "undo", Needs::Undo},
    Action{"redo", "Edit", "Redo", "Ctrl+Y", "redo", Needs::Redo},
    Action{"find", "Edit", "Find vertex or element…", "Ctrl+F", "dialog find", Needs::Mesh, true},
    Action{"leave", "Edit", "Leave the brush, or clear the selection", "Escape", "leave", Needs::Leavable},
    Action{"pick-none", "Edit", "Clear selection", "", "pick none", Needs::Picked},
    Action{"rename-run", "Edit", "Rename the run…", "Shift+F2", "begin-rename", Needs::Mesh, true},

    Action{"run-pause", "Run", "Run / pause", "Space", "run-pause", Needs::Mesh},
    Action{"run-10", "Run", "Run 10 iterations", "Shift+N", "run 10", Needs::MeshAndIdle},
    Action{
        "make-good", "Run", "Make it good", "Shift+U", "make-good", Needs::MeshAndIdle, false,
        "All that there is, until it has converged: DMO, then joint moves until the minimum is within 0.3 % of what can be reached, then "
        "the best mean that keeps it. The run before is kept."},
    Action{"until-converged", "Run", "Until converged", "U", "until-converged best", Needs::MeshAndIdle},
    Action{"cancel", "Run", "Cancel", "Shift+Escape", "cancel", Needs::Work},
    Action{"step-iteration", "Run", "Next iteration", "N", "step iteration", Needs::MeshAndIdle, true},
    Action{"step-class", "Run", "Next colour class", "C", "step class", Needs::MeshAndIdle},
    Action{"step-vertex", "Run", "Next vertex", "V", "step vertex", Needs::MeshAndIdle},
    Action{"back-iteration", "Timeline", "Back one iteration", "B", "back iteration", Needs::MeshAndIdle},
    Action{"back-class", "Timeline", "Back one colour class", "Shift+C", "back class", Needs::MeshAndIdle},
    Action{"back-vertex", "Timeline", "Back one vertex", "Shift+V", "back vertex", Needs::MeshAndIdle},
    Action{"reset", "Run", "Reset to the input", "R", "reset", Needs::MeshAndIdle},
    Action{"formula", "Run", "A metric of your own…", "", "dialog formula", Needs::Mesh, true},
    Action{"timeline-back", "Timeline", "Earlier", "[", "timeline back", Needs::MeshAndIdle, true},
    Action{"timeline-forward", "Timeline", "Later", "]", "timeline forward", Needs::MeshAndIdle},
    Action{"timeline-first", "Timeline", "Input", "Home", "timeline first", Needs::MeshAndIdle},
    Action{"timeline-last", "Timeline", "Latest", "End", "timeline last", Needs::MeshAndIdle},
    Action{"best", "Timeline", "Best iteration", "Shift+End", "best", Needs::Better},
    Action{"play", "Play", "Play the history", "P", "play toggle", Needs::Mesh},
    Action{"play-iterations", "Play", "Step iterations until stopped", "Shift+P", "play-steps iteration", Needs::Mesh},
    Action{"play-classes", "Play", "Step colour classes until stopped", "", "play-steps class", Needs::Mesh},
    Action{"play-vertices", "Play", "Step vertices until stopped", "", "play-steps vertex", Needs::Mesh},
    Action{"slower", "Play", "Slower", ",", "speed down"},
    Action{"faster", "Play", "Faster", ".", "speed up"},
    Action{"mark-a", "Marks A and B", "Mark what is shown as A", "Shift+A", "mark a", Needs::Mesh},
    Action{"mark-b", "Marks A and B", "Mark what is shown as B", "Shift+B", "mark b", Needs::Mesh},
    Action{"flip", "Marks A and B", "Flip between A and B", "X", "flip", Needs::Mesh},
    Action{"flip-now", "Marks A and B", "Back to the current mesh", "Shift+X", "flip now", Needs::Mesh},
    Action{"next-run", "Run", "Next run", "Alt+N", "next-run", Needs::SeveralRuns, true},

    Action{"compare-runs", "Compare", "Methods and metrics…", "", "dialog compare", Needs::MeshAndIdle},
    Action{"every-method", "Compare", "Same metric, every method", "", "compare methods", Needs::MeshAndIdle},
    Action{"every-metric", "Compare", "Same mesh, every metric", "", "compare metrics", Needs::MeshAndIdle},
    Action{"every-order", "Compare", "Same run, 10 shuffled orders", "", "compare orders 10", Needs::MeshAndIdle},
    Action{"each-step", "Compare", "Every run: next iteration", "Ctrl+N", "each step", Needs::MeshAndIdle, true},
    Action{"each-10", "Compare", "Every run: 10 iterations", "Ctrl+Shift+N", "each run 10", Needs::MeshAndIdle},
    Action{"each-converged", "Compare", "Every run: until converged", "Ctrl+U", "each until-converged best", Needs::MeshAndIdle},
    Action{"each-back", "Compare", "Every run: back one iteration", "Ctrl+B", "each back", Needs::MeshAndIdle},
    Action{"each-reset", "Compare", "Every run: reset to the input", "Ctrl+R", "each reset", Needs::MeshAndIdle},

    Action{"arrows-longer", "Stepping", "Longer arrows", "Ctrl+A", "arrow-scale up", Needs::Mesh},
    Action{"arrows-shorter", "Stepping", "Shorter arrows", "Ctrl+Shift+A", "arrow-scale down", Needs::Mesh},
    Action{"arrows-auto", "Stepping", "Automatic arrow length", "", "arrow-scale auto", Needs::Mesh},
    Action{"brush-wider", "Stepping", "Wider brush", "Shift+S", "brush-radius up", Needs::Planar},
    Action{"brush-narrower", "Stepping", "Narrower brush", "Alt+S", "brush-radius down", Needs::Planar},
    Action{"smooth-selected", "Stepping", "Smooth the selected vertices", "Ctrl+Space", "smooth-selected", Needs::Selected, true},
    Action{"fix-selected", "Stepping", "Fix the selected vertices", "Ctrl+Shift+F", "fix-selected", Needs::Selected},
    Action{"select-none", "Stepping", "Select no vertices", "Ctrl+D", "select none", Needs::Selected},

    Action{"fit", "View", "Fit", "F", "fit", Needs::Mesh},
    Action{"zoom-in", "View", "Zoom in", "+", "zoom 1.25", Needs::Mesh},
    Action{"zoom-out", "View", "Zoom out", "-", "zoom 0.8", Needs::Mesh},
    Action{"next-metric", "View", "Show the next metric", "M", "next-metric", Needs::Mesh, true},
    Action{"inside-axis", "Inside", "Clip plane across the next axis", "Ctrl+J", "clip next", Needs::Volume},
    Action{"inside-flip", "Inside", "Clip plane: the other side", "Shift+J", "clip flip", Needs::Volume},
    Action{"inside-peel", "Inside", "Peel one more layer off", "Y", "peel more", Needs::Volume, true},
    Action{"inside-unpeel", "Inside", "Put one layer back", "Shift+Y", "peel less", Needs::Volume},
    Action{"inside-all", "Inside", "Show all cells", "Z", "show-all", Needs::Volume, true},
    Action{"from-iso", "Look from", "Look at a corner", "Alt+I", "view-from iso", Needs::Volume},
    Action{"from-x", "Look from", "Look from +x", "Alt+X", "view-from +x", Needs::Volume, true},
    Action{"from-minus-x", "Look from", "Look from -x", "Shift+Alt+X", "view-from -x", Needs::Volume},
    Action{"from-y", "Look from", "Look from +y", "Alt+Y", "view-from +y", Needs::Volume},
    Action{"from-minus-y", "Look from", "Look from -y", "Shift+Alt+Y", "view-from -y", Needs::Volume},
    Action{"from-z", "Look from", "Look from +z", "Alt+Z", "view-from +z", Needs::Volume},
    Action{"from-minus-z", "Look from", "Look from -z", "Shift+Alt+Z", "view-from -z", Needs::Volume},
    Action{"scale-up", "View", "Larger interface", "Ctrl+=", "scale up"},
    Action{"scale-down", "View", "Smaller interface", "Ctrl+-", "scale down"},
    Action{"scale-one", "View", "Interface at its usual size", "Ctrl+0", "scale 1"},
    Action{"notice-off", "View", "Hide the note about the run's end", "", "notice off"},
    Action{"log", "View", "Log of commands and messages…", "F6", "dialog log", Needs::Nothing, true},

    Action{"plot-all", "Plot", "The plot as at first", "Alt+0", "plot-zoom all"},
    Action{"plot-save", "Plot", "Save the plot…", "Alt+P", "dialog plot", Needs::Mesh, true},
    Action{"plot-copy", "Plot", "Copy the plot's data", "Alt+C", "plot-copy", Needs::Mesh},

    Action{"inspect", "Inspect", "Grid inspection", "G", "inspect toggle", Needs::Mesh},
    Action{"inspect-next", "Inspect", "The vertex visited next", "Shift+G", "inspect-next", Needs::MeshAndIdle},
    Action{"inspect-worst", "Inspect", "The worst element that can be changed", "Ctrl+G", "inspect-worst", Needs::MeshAndIdle},
    Action{"held-by", "Inspect", "What holds the minimum", "", "held-by", Needs::MeshAndIdle},
    Action{"make-corner", "Inspect", "Corner: the picked vertex stays", "Alt+V", "make corner", Needs::Chosen, true},
    Action{"make-no-corner", "Inspect", "No corner: the picked vertex slides", "Shift+Alt+V", "make no-corner", Needs::Chosen},
    Action{"make-auto-corner", "Inspect", "The picked vertex is a corner where file and angles say so", "", "make auto-corner",
           Needs::Chosen},
    Action{"all-automatic", "Inspect", "All corners as file and angles say", "", "auto-corner", Needs::MeshAndIdle},
    Action{"all-features-automatic", "Inspect", "All feature edges as file and angles say", "", "auto-feature", Needs::MeshAndIdle},
    Action{"level-next", "Inspect", "Next level, then apply", "L", "level next", Needs::MeshAndIdle, true},
    Action{"level-back", "Inspect", "Previous level", "Shift+L", "level back", Needs::MeshAndIdle},
    Action{"level-all", "Inspect", "All levels at once", "Ctrl+L", "level all", Needs::MeshAndIdle},
    Action{"play-levels", "Inspect", "Play the levels", "Ctrl+Shift+L", "play-levels", Needs::MeshAndIdle},
    Action{"apply-move", "Inspect", "Apply the move", "", "apply-move", Needs::MeshAndIdle},
    Action{"copy-level", "Inspect", "Copy the shown level as CSV", "", "copy-level", Needs::MeshAndIdle, true},

    Action{"filter-off", "Colours", "No filter", "", "filter off", Needs::Nothing, true},
    Action{"isolate-off", "Colours", "All categories", "", "isolate off"},
    Action{"fit-worst", "Colours", "Go to the worst elements", "Ctrl+K", "fit-worst", Needs::Mesh},

    Action{"palette", "Help", "All commands…", "Ctrl+P", "dialog palette"},
    Action{"tour", "Help", "Tour: two minutes of guided steps", "", "tour on"},
    Action{"keys", "Help", "Keys", "F1", "dialog keys"},
    Action{"about", "Help", "About", "", "dialog about"},
};

/// All actions; those of options are inserted below the actions that their rows name.
class ActionTable {
 public:
  ActionTable() : rows_(kActions.begin(), kActions.end()) {
    std::string_view after = "reload";
    for (const GeneratorInfo& sample : generator_table()) {
      const std::string_view id = keep(fmt::format("sample-{}", sample.name)), line = keep(fmt::format("generate {}", sample.name));
      const bool apart = after == "reload" || sample.name == "tetrahedra";  // volumes, and planar samples that came later
      insert(after, {id, {}, keep(fmt::format("Sample: {}", sample.name)), {}, line, Needs::Nothing, apart});
      after = id;
    }
    for (const ViewOption& option : view_options()) {
      if (!option.entry.after.empty()) add_own(option);
      if (!option.entries.after.empty()) add_choices(option);
    }
  }
  [[nodiscard]] std::span<const Action> rows() const noexcept { return rows_; }

 private:
  void add_own(const ViewOption& option) {
    const std::string_view id = option.entry.id.empty() ? option.command : option.entry.id;
    const std::string_view line = keep(fmt::format("{} {}", option.command, option.turn_word()));
    insert(option.entry.after, {id, option.entry.menu, option.entry.title, option.entry.key, line, option.entry.needs, option.entry.apart});
  }
  void add_choices(const ViewOption& option) {
    std::string_view after = option.entries.after;
    for (const OptionChoice& choice : option.at.choices) {
      if (choice.title.empty() && choice.entry.empty()) continue;
      const std::string_view id = choice.id.empty() ? keep(fmt::format("{}-{}", option.command, choice.word)) : choice.id;
      const std::string_view title = !choice.entry.empty()          ? choice.entry
                                     : option.entries.title.empty() ? choice.title
                                                                    : keep(fmt::format("{}: {}", option.entries.title, choice.title));
      const std::string_view line = keep(fmt::format("{} {}{}", option.command, choice.word, option.entries.toggles ? " toggle" : ""));
      insert(after,
             {id, option.entries.menu, title, choice.key, line, option.entry.needs, option.entries.apart && after == option.entries.after});
      after = id;
    }
  }
  void insert(std::string_view after, Action action) {
    const auto above = std::ranges::find(rows_, after, &Action::id);
    if (action.menu.empty()) action.menu = above->menu;
    rows_.insert(above + 1, action);
  }
  std::string_view keep(std::string text) { return texts_.emplace_back(std::move(text)); }

  std::vector<Action> rows_;
  std::deque<std::string> texts_;  // texts that the rows point into
};

}  // namespace

std::span<const Action> actions() {
  static const ActionTable table;
  return table.rows();
}

const Action* find_action(std::string_view id) {
  const auto at = std::ranges::find(actions(), id, &Action::id);
  return at == actions().end() ? nullptr : &*at;
}

const Action* action_of(const KeyChord& chord) {
  // "+" is Shift+"=" on many keyboards, and a key of its own on others; key codes know only "=".
  KeyChord wanted = chord;
  if (chord.code == '=' && !chord.ctrl && !chord.alt) wanted = {'+', false, false, false};
  if (wanted == parse_key("Ctrl+Shift+Z")) wanted = *parse_key("Ctrl+Y");  // people know either
  for (const Action& action : actions()) {
    if (!action.key.empty() && parse_key(action.key) == wanted) return &action;
  }
  return nullptr;
}

std::vector<std::string_view> menu_names() {
  std::vector<std::string_view> names;
  for (const Action& action : actions()) {
    if (std::find(names.begin(), names.end(), action.menu) == names.end()) names.push_back(action.menu);
  }
  return names;
}

bool enabled(const Action& action, const Situation& now) {
  const bool ready = now.mesh && !now.busy;
  const std::array<bool, 14> met{true,  // in the order of Needs
                                 now.mesh,
                                 ready,
                                 now.busy,
                                 ready && now.runs > 1,
                                 now.picked,
                                 ready && now.selected,
                                 !now.busy && !now.undo.empty(),
                                 !now.busy && !now.redo.empty(),
                                 now.mesh && now.volume,
                                 now.mesh && !now.volume,
                                 ready && now.better,
                                 now.picked || now.leavable,
                                 ready && (now.selected || now.picked)};
  return met[static_cast<std::size_t>(action.needs)];
}

std::string title_of(const Action& action, const Situation& now) {
  const std::string& about = action.needs == Needs::Undo ? now.undo : action.needs == Needs::Redo ? now.redo : std::string();
  return about.empty() ? std::string(action.title) : std::string(action.title) + ' ' + about;
}

std::vector<std::string> search_words(std::string_view query) {
  const std::string wanted = lower_case(query);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < wanted.size();) {
    const std::size_t end = std::min(wanted.find(' ', at), wanted.size());
    if (end > at) words.push_back(wanted.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

bool holds_all(std::string_view text, std::span<const std::string> words) {
  const std::string low = lower_case(text);
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) { return low.find(word) != std::string::npos; });
}

std::vector<const Action*> search_actions(std::string_view query) {
  const std::vector<std::string> words = search_words(query);
  std::vector<const Action*> found;
  for (const Action& action : actions()) {
    std::string text;
    for (const std::string_view part : {action.title, action.menu, action.command, action.id}) text.append(part).append("\n");
    if (holds_all(text, words)) found.push_back(&action);
  }
  const std::string wanted = lower_case(query);
  std::stable_partition(found.begin(), found.end(), [&](const Action* action) { return lower_case(action->title).starts_with(wanted); });
  return found;
}

Situation situation_of(const SessionView& session, const ViewState& state, bool busy) {
  Situation now;
  now.mesh = session.input != nullptr;
  now.busy = busy;
  now.picked = state.picked.kind != Picked::Kind::None;
  now.runs = session.runs.size();
  now.selected = !state.selection.empty();
  now.undo = session.undo_label;
  now.redo = session.redo_label;
  now.volume = state.in_space;
  now.better = session.active < session.runs.size() && !session.runs[session.active].at_best();
  now.leavable = state.brush.on || state.placing_size_point || state.renaming_run;
  return now;
}

std::vector<PaletteEntry> palette_entries(std::string_view text, const Situation& situation, std::span<const CommandInfo> window_commands) {
  const std::string_view command = text.substr(0, text.find(' '));
  const bool has_words = text.find_first_not_of(' ', command.size()) != std::string_view::npos;
  std::vector<const CommandInfo*> commands;
  for (const std::span<const CommandInfo> table : {window_commands, std::span<const CommandInfo>(session_commands())}) {
    for (const CommandInfo& one : table) commands.push_back(&one);
  }
  std::vector<PaletteEntry> entries;
  for (const CommandInfo* one : commands) {
    if (has_words && one->name == command) entries.push_back({fmt::format("run: {}", text), one->usage, std::string(text), true, true});
  }
  for (const Action* action : search_actions(text)) {
    const std::string title = title_of(*action, situation);
    entries.push_back({fmt::format("{}: {}", action->menu, title), std::string(action->key), std::string(action->command),
                       enabled(*action, situation), true, title});
  }
  const std::vector<std::string> words = search_words(text);
  // Commands that begin with the typed text come before those that only contain it.
  for (const bool begins : {true, false}) {
    for (const CommandInfo* one : commands) {
      if ((has_words && one->name == command) || one->name.starts_with(command) != begins) continue;
      if (!holds_all(one->usage + "\n" + one->doc, words)) continue;
      const bool complete = one->usage == one->name;
      entries.push_back({one->usage, one->doc, complete ? one->name : one->name + " ", true, complete});
    }
  }
  // Entries that are impossible now come last, and those with exactly this name first.
  std::ranges::stable_sort(entries, {},
                           [&](const PaletteEntry& one) { return one.possible ? !text.empty() && one.name == text ? 0 : 1 : 2; });
  return entries;
}

}  // namespace dmoscope::ui
