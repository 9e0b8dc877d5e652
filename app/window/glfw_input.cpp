#include "app/window/glfw_input.h"

#include <cfloat>
#include <string_view>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace dmoscope::app {
namespace {

KeyQueue& keys() { return *static_cast<KeyQueue*>(ImGui::GetIO().UserData); }

/// Code of a key by its label: GLFW numbers keys by their places on an American keyboard, whose Z is elsewhere on a German one. Digits keep
/// their places, as some keyboards have them on Shift.
int code_of(int key, int scancode) {
  if (key < 0 || key >= IM_ARRAYSIZE(ImGuiIO::KeysDown)) return 0;
  if (key <= GLFW_KEY_SPACE || key >= GLFW_KEY_ESCAPE || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)) return key;
  const char* name = glfwGetKeyName(key, scancode);
  const std::string_view written = name == nullptr ? std::string_view() : name;
  if (written.size() != 1 || written[0] <= ' ' || written[0] > '~') return key;
  return written[0] >= 'a' && written[0] <= 'z' ? written[0] - 'a' + 'A' : written[0];
}

void on_key(GLFWwindow* /*window*/, int key, int scancode, int action, int modifiers) {
  const int code = code_of(key, scancode);
  if (action == GLFW_RELEASE) return keys().release(code);
  const ui::KeyChord chord{code, (modifiers & GLFW_MOD_CONTROL) != 0, (modifiers & GLFW_MOD_SHIFT) != 0, (modifiers & GLFW_MOD_ALT) != 0};
  keys().press(chord, action == GLFW_REPEAT);
}

void on_character(GLFWwindow* /*window*/, unsigned character) { keys().character(character); }

void on_mouse_button(GLFWwindow* window, int button, int action, int modifiers) {
  if (action == GLFW_PRESS) keys().click();
  ImGui_ImplGlfw_MouseButtonCallback(window, button, action, modifiers);
}

void on_focus(GLFWwindow* window, int focused) {
  if (focused == GLFW_FALSE) keys().lose_focus();
  ImGui_ImplGlfw_WindowFocusCallback(window, focused);
}

}  // namespace

GlfwInput::GlfwInput(GLFWwindow* window, KeyQueue& keys) {
  ImGui::GetIO().UserData = &keys;
  ImGui_ImplGlfw_InitForOpenGL(window, false);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_character);
  glfwSetMouseButtonCallback(window, on_mouse_button);
  glfwSetWindowFocusCallback(window, on_focus);
  glfwSetCursorEnterCallback(window, ImGui_ImplGlfw_CursorEnterCallback);
  glfwSetScrollCallback(window, ImGui_ImplGlfw_ScrollCallback);
  glfwSetMonitorCallback(ImGui_ImplGlfw_MonitorCallback);
}

GlfwInput::~GlfwInput() { ImGui_ImplGlfw_Shutdown(); }

void GlfwInput::begin_frame(render::Extent size) {
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2 ratio = io.DisplayFramebufferScale;
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  io.DisplayFramebufferScale = {1.0F, 1.0F};
  if (io.MousePos.x > -FLT_MAX) io.MousePos = {io.MousePos.x * ratio.x, io.MousePos.y * ratio.y};
}

}  // namespace dmoscope::app
