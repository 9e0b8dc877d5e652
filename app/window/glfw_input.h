#pragma once
// GLFW's half of ImGui.

#include <deque>
#include <optional>

#include "render/window.h"

namespace dmoscope::app {

/// Feeds ImGui with the window's events. A key pressed and released between two frames, which ImGui would never see, is kept down
/// for one frame.
class GlfwInput {
 public:
  explicit GlfwInput(GLFWwindow* window);
  ~GlfwInput();
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;

  /// Before ImGui::NewFrame. `size`: of the framebuffer, in whose pixels the interface is laid out and the mouse is told.
  void begin_frame(render::Extent size);
  /// After ImGui::Render.
  void end_frame();
  /// True while presses wait for a frame of their own.
  [[nodiscard]] bool waiting() const noexcept { return !presses_.empty(); }

  struct Press {
    int key = 0, modifiers = 0;
  };
  void pressed(Press press) { presses_.push_back(press); }

 private:
  std::deque<Press> presses_;
  std::optional<int> held_;  // the key kept down for this frame
};

}  // namespace dmoscope::app
