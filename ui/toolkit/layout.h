#pragma once
// Which part of the window each panel gets.

#include "ui/state/layout_rect.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

struct Layout {
  Rect toolbar, left, viewport, right, bottom, status;
  Rect left_strip, right_strip;  // instead of the panels where the window is too small
  bool folded = false;           // side panels are strips, and open over the mesh
  bool timeline_only = false;    // the plots are closed, or there is no room for them
};

/// All in pixels. `timeline`: whether there is one, with plots above it where these are open. `em`: the interface font's height; `menu`:
/// the menu bar's. The mesh keeps at least 24 em of width; widths and heights of the panels are limited so that it does.
[[nodiscard]] Layout compute_layout(const Panels& panels, float width, float height, float em, float menu, bool timeline = true);

}  // namespace dmoscope::ui
