#pragma once

namespace dmoscope::ui {

/// Rectangle in pixels of the window.
struct Rect {
  float x = 0, y = 0, w = 0, h = 0;
  [[nodiscard]] bool empty() const noexcept { return w <= 0 || h <= 0; }
};

}  // namespace dmoscope::ui
