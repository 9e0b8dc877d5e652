#pragma once
// GLFW's half of ImGui.

#include "app/window/key_queue.h"
#include "render/window.h"

namespace dmoscope::app {

/// Feeds ImGui with the window's mouse, and `keys` with its keyboard.
class GlfwInput {
 public:
  GlfwInput(GLFWwindow* window, KeyQueue& keys);
  ~GlfwInput();
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;

  /// Before ImGui::NewFrame. `size`: of the framebuffer, in whose pixels the interface is laid out and the mouse is told.
  void begin_frame(render::Extent size);
};

}  // namespace dmoscope::app
