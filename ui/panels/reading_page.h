#pragma once
// Pages in place of a mesh that is being read or prepared.

#include "ui/panels/panel_context.h"
#include "ui/toolkit/reading.h"

namespace dmoscope::ui {

/// Draws the page in the start page's place while the first file is read: its name, progress, and Cancel.
void draw_reading_page(PanelContext& context, const Rect& rect, const BeingRead& reading);
/// Draws a note in place of a mesh that is made ready for drawing.
void draw_preparing(const PanelContext& context, const PaneFacts& pane);

}  // namespace dmoscope::ui
