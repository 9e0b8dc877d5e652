#pragma once
// The view as a JSON object, for a saved session, and as commands, for a script. Members that are not known are ignored; those that are
// missing keep their value.

#include <string>
#include <string_view>
#include <vector>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Camera, colours, panels, plots and pick as JSON on one line.
[[nodiscard]] std::string view_json(const ViewState& state);

/// Takes over a view. `mesh`: the open mesh, null for none; the pick must exist there. Throws UsageError that names the invalid member; the
/// state is then unchanged.
void apply_view_json(std::string_view text, ViewState& state, const Mesh* mesh);

/// Lines for everything that mouse and settings can change: the window's size, theme, panels, the picture's options and, `with_camera`, the
/// camera.
[[nodiscard]] std::vector<std::string> view_lines(const ViewState& state, bool with_camera);

}  // namespace dmoscope::ui
