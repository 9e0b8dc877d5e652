#pragma once
// The look of the window as command lines, each of which sets one thing of it whatever it was before.

#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// What the mouse and the settings can change: the window's size, theme, panels, the picture's ways and, `with_camera`, the camera.
[[nodiscard]] std::vector<std::string> view_lines(const ViewState& state, bool with_camera);

}  // namespace dmoscope::ui
