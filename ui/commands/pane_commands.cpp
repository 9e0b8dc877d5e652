
#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

std::size_t to_pane(const ViewState& state, const std::string& word) {
  const std::uint64_t number = to_count(word, 1);
  const std::size_t count = state.panes.count();
  if (number > count)
    throw UsageError(
        fmt::format("there is no pane {}: {} shown now (viewports)", number, count == 1 ? "one is" : fmt::format("{} are", count)));
  return number - 1;
}

void set_pane(ViewState& state, Arguments words) {
  Pane& pane = state.panes.panes[to_pane(state, words[0])];
  pane.content = state.panes.parse({words.begin() + 1, words.end()});
  pane.chosen = pane.content.kind != PaneContent::Kind::Free;
  if (pane.content.kind == PaneContent::Kind::Run) state.panes.hide_run(pane.content.run, false);  // a run that was asked for is to be seen
}

void hide_runs(Panes& panes, Arguments words) {
  if (words[0] == "none" || words[0] == "others") {
    require(words, 1, 1);
    for (const std::uint64_t id : panes.run_ids) panes.hide_run(id, words[0] == "others" && id != panes.active_id);
    return;
  }
  const PaneContent run = panes.parse({"run", words[0]});
  panes.hide_run(run.run, switched(words, 1, panes.hidden_runs.contains(run.run)));
}

void set_pane_camera(ViewState& state, Arguments words) {
  const std::size_t pane = to_pane(state, words[0]);
  const render::Camera2D camera{{to_number(words[1]), to_number(words[2])}, to_number(words[3])};
  if (!(camera.units_per_pixel > 0.0)) throw UsageError("units per pixel must be greater than 0");
  state.camera_of(pane) = camera;
}

}  // namespace

void add_pane_commands(CommandTable& table, ViewState& state) {
  table.add({"pane", "pane K active|run N [ITERATION]|input|mark a|b|auto",
             "what viewport K shows: a run as it stands or at an iteration, the input, a mark; auto: what is not shown elsewhere"},
            {2, 4}, [&state](Arguments words) { set_pane(state, words); });
  table.add({"focus-pane", "focus-pane K", "makes viewport K the active one, which the camera's commands are about"}, {1, 1},
            [&state](Arguments words) { state.focus_pane(to_pane(state, words[0])); });
  table.add({"pane-camera", "pane-camera K X Y UNITS-PER-PIXEL", "as camera, for one viewport while they are not linked"}, {4, 4},
            [&state](Arguments words) { set_pane_camera(state, words); });
  table.add({"hide-run", "hide-run K|others [on|off|toggle]  or  hide-run none",
             "takes a run, or all but the active one, out of plots and viewports; none: all are there again"},
            {1, 2}, [&state](Arguments words) { hide_runs(state.panes, words); });
  table.add({"begin-rename", "begin-rename [K]", "lets a person type another name for run K, or the active one, into the list of runs"},
            {0, 1}, [&state](Arguments words) {
              const Panes& panes = state.panes;
              if (panes.run_ids.empty()) throw UsageError("no mesh is open");
              state.renaming_run = words.empty() ? panes.active_id : panes.parse({"run", words[0]}).run;
              state.panels.setup = true;  // the dock with the list
              (state.panels.setup_side == Side::Left ? state.panels.left_over : state.panels.right_over) = true;
            });
}

}  // namespace dmoscope::ui
