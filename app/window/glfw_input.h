#pragma once
// Input from GLFW for ImGui.

#include "app/window/key_queue.h"
#include "render/window.h"

namespace dmoscope::app {

/// Passes the window's mouse to ImGui, and its keyboard to `keys`.
class GlfwInput {
 public:
  GlfwInput(GLFWwindow* window, KeyQueue& keys);
  ~GlfwInput();
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;

  /// Passes the input of a frame; to be called before ImGui::NewFrame. `size`: of the framebuffer, whose pixels the interface and the mouse
  /// use.
  void begin_frame(render::Extent size);
};

}  // namespace dmoscope::app
