#include "ui/toolkit/tooltips.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

namespace dmoscope::ui {

bool tooltip_unsettled() {
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
  return std::any_of(windows.begin(), windows.end(), [](ImGuiWindow* window) {
    if (!window->Active || (window->Flags & ImGuiWindowFlags_Tooltip) == 0) return false;
    if (window->Hidden) return true;  // ImGui measures it before it shows it
    const ImVec2 wanted = ImGui::CalcWindowNextAutoFitSize(window);
    constexpr float kHalfPixel = 0.5F;
    return std::abs(wanted.x - window->Size.x) > kHalfPixel || std::abs(wanted.y - window->Size.y) > kHalfPixel;
  });
}

}  // namespace dmoscope::ui
