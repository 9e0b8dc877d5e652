#include "app/window/glfw_input.h"

#include <cfloat>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace dmoscope::app {
namespace {

void on_key(GLFWwindow* /*window*/, int key, int /*scancode*/, int action, int modifiers) {
  if (action != GLFW_PRESS || key < 0 || key >= IM_ARRAYSIZE(ImGuiIO::KeysDown)) return;
  static_cast<GlfwInput*>(ImGui::GetIO().UserData)->pressed({key, modifiers});
}

void set_modifiers(ImGuiIO& io, bool ctrl, bool shift, bool alt) {
  io.KeyCtrl = ctrl;
  io.KeyShift = shift;
  io.KeyAlt = alt;
}

}  // namespace

GlfwInput::GlfwInput(GLFWwindow* window) {
  ImGui::GetIO().UserData = this;
  glfwSetKeyCallback(window, on_key);  // ImGui's own callback calls it first
  ImGui_ImplGlfw_InitForOpenGL(window, true);
}

GlfwInput::~GlfwInput() { ImGui_ImplGlfw_Shutdown(); }

void GlfwInput::begin_frame(render::Extent size) {
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2 ratio = io.DisplayFramebufferScale;
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  io.DisplayFramebufferScale = {1.0F, 1.0F};
  if (io.MousePos.x > -FLT_MAX) io.MousePos = {io.MousePos.x * ratio.x, io.MousePos.y * ratio.y};

  if (presses_.empty()) return;
  const Press press = presses_.front();
  presses_.pop_front();
  if (io.KeysDown[press.key]) return;
  io.KeysDown[press.key] = true;
  held_ = press.key;
  set_modifiers(io, (press.modifiers & GLFW_MOD_CONTROL) != 0, (press.modifiers & GLFW_MOD_SHIFT) != 0,
                (press.modifiers & GLFW_MOD_ALT) != 0);
}

void GlfwInput::end_frame() {
  if (!held_) return;
  ImGuiIO& io = ImGui::GetIO();
  io.KeysDown[*held_] = false;
  held_.reset();
  set_modifiers(io, io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL],
                io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT],
                io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT]);
}

}  // namespace dmoscope::app
