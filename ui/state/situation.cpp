#include "ui/state/situation.h"

namespace dmoscope::ui {

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

}  // namespace dmoscope::ui
