#pragma once
// Finds tooltips of a wrong size: ImGui gives a tooltip the size of its content in the frame before.

namespace dmoscope::ui {

/// Whether a tooltip of this frame has another size than its content needs, so that it takes one more frame. To be called once all is
/// drawn, before ImGui::Render.
[[nodiscard]] bool tooltip_unsettled();

}  // namespace dmoscope::ui
