#pragma once
// ImGui gives a tooltip the size that its content had in the frame before.

namespace dmoscope::ui {

/// Whether a tooltip of this frame has another size than its content wants: it takes one more frame to be right. To be asked once all is
/// drawn, before ImGui::Render.
[[nodiscard]] bool tooltip_unsettled();

}  // namespace dmoscope::ui
