#pragma once
// The look of the window as command lines. Each line sets one thing, whatever it was before.

#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Lines for everything that mouse and settings can change: the window's size, theme, panels, the picture's options and, `with_camera`, the
/// camera.
[[nodiscard]] std::vector<std::string> view_lines(const ViewState& state, bool with_camera);

}  // namespace dmoscope::ui
