#pragma once
// Division of the window into panels.

#include "ui/state/panes.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

struct Layout {
  Rect menu, toolbar;     // menus and tools, in one row if there is room
  Rect left, right;       // columns of docks
  Rect viewport, bottom;  // the plots stand below the viewport only
  Rect timeline, status;  // the lowest row
  bool folded = false;    // the window is too small for columns beside the mesh; they open over it
  /// Part of the viewport that open columns over it leave uncovered.
  [[nodiscard]] Rect uncovered() const;
};

/// Height of the interface's font, and widths of menus and tools in one row, in pixels.
struct HeaderSize {
  float em = 15.0F, menu = 0.0F, tools = 0.0F;
};

/// Places of all parts of the window, in pixels. `mesh`: a mesh is open, so that there are a timeline and plots. The mesh keeps at least 24
/// em of width; widths and heights of the panels are limited so that it does.
[[nodiscard]] Layout compute_layout(const Panels& panels, float width, float height, const HeaderSize& header, bool mesh = true);

}  // namespace dmoscope::ui
