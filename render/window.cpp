#include "render/window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <glad/gl.h>

#include "core/base/error.h"

namespace dmoscope::render {

struct WindowHooks {
  static void drop(GLFWwindow* handle, int count, const char** paths) {
    auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
    if (!window->drop_) return;
    window->drop_(std::vector<std::filesystem::path>(paths, paths + count));
  }
};

namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  const int code = glfwGetError(&text);
  return code == GLFW_NO_ERROR || text == nullptr ? std::string("no reason given") : std::string(text);
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

bool has_display() { return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"); }

std::unique_ptr<Window> Window::create(const Options& options) {
  if (glfwInit() != GLFW_TRUE) {
    throw Error(fmt::format("no window can be opened: {}{}", last_glfw_error(),
                            has_display() ? "" : "; there is no display (DISPLAY and WAYLAND_DISPLAY are not set)"));
  }
  std::unique_ptr<Window> window(new Window);
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
#ifndef NDEBUG
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
#endif
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "dmoscope");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "dmoscope");
  window->handle_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (window->handle_ == nullptr) {
    throw Error(
        fmt::format("no window with OpenGL 4.5 can be opened: {}; needed: a graphics driver with OpenGL 4.5 (for Mesa: package "
                    "libgl1-mesa-dri)",
                    last_glfw_error()));
  }
  glfwSetWindowUserPointer(window->handle_, window.get());
  glfwSetDropCallback(window->handle_, WindowHooks::drop);
  window->make_current();
  if (gladLoadGL(reinterpret_cast<GLADloadfunc>(glfwGetProcAddress)) == 0) throw Error("OpenGL's functions cannot be loaded");
  window->adopt("window");
  glfwSwapInterval(1);
  return window;
}

Window::~Window() {
  if (handle_ != nullptr) glfwDestroyWindow(handle_);
  glfwTerminate();
}

void Window::make_current() {
  glfwMakeContextCurrent(handle_);
  if (glfwGetCurrentContext() != handle_) throw Error(fmt::format("the window's context cannot be made current: {}", last_glfw_error()));
}

Extent Window::framebuffer_size() const {
  Extent size;
  glfwGetFramebufferSize(handle_, &size.width, &size.height);
  return size;
}

float Window::content_scale() const {
  float x = 1.0F, y = 1.0F;
  glfwGetWindowContentScale(handle_, &x, &y);
  const float scale = std::max(x, y);
  return std::isfinite(scale) && scale > 0.0F ? scale : 1.0F;
}

bool Window::should_close() const { return glfwWindowShouldClose(handle_) == GLFW_TRUE; }
void Window::set_should_close(bool close) { glfwSetWindowShouldClose(handle_, close ? GLFW_TRUE : GLFW_FALSE); }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(handle_, title.c_str()); }

void Window::set_full_screen(bool full) {
  if (full == full_screen_) return;
  if (full) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return;
    glfwGetWindowPos(handle_, &restore_[0], &restore_[1]);
    glfwGetWindowSize(handle_, &restore_[2], &restore_[3]);
    glfwSetWindowMonitor(handle_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(handle_, nullptr, restore_[0], restore_[1], restore_[2], restore_[3], GLFW_DONT_CARE);
  }
  full_screen_ = full;
  glfwSwapInterval(1);
}

void Window::swap() { glfwSwapBuffers(handle_); }

void Window::wait_events(double seconds) {
  if (seconds <= 0.0) {
    glfwPollEvents();
  } else if (std::isinf(seconds)) {
    glfwWaitEvents();
  } else {
    glfwWaitEventsTimeout(seconds);
  }
}

void Window::wake() { glfwPostEmptyEvent(); }

void Window::on_drop(std::function<void(std::vector<std::filesystem::path>)> hook) { drop_ = std::move(hook); }

}  // namespace dmoscope::render
