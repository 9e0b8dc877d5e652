#pragma once
// What stands in the place of a mesh that is on its way.

#include "ui/panels/panel_context.h"
#include "ui/toolkit/reading.h"

namespace dmoscope::ui {

/// In the start page's place while a file is read that will be the first: what, how far, and Cancel.
void draw_reading_page(PanelContext& context, const Rect& rect, const BeingRead& reading);
/// In the place of a mesh that is made ready for drawing.
void draw_preparing(const PanelContext& context, const PaneFacts& pane);

}  // namespace dmoscope::ui
