#pragma once
// The one window of the program on a desktop (GLFW).

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/context.h"

struct GLFWwindow;

namespace dmoscope::render {

struct Extent {
  int width = 0, height = 0;
  friend bool operator==(const Extent&, const Extent&) = default;
};

/// A window with its context. One at a time; make it and use it on the main thread (wake() may come from any).
class Window final : public Context {
 public:
  struct Options {
    std::string title = "dmoscope";
    int width = 1280, height = 800;  // screen coordinates
    bool visible = true;
  };
  /// Opens the window and makes its context current, with vertical synchronisation. Throws Error when there is no display
  /// (has_display() is false then) or no OpenGL 4.5.
  [[nodiscard]] static std::unique_ptr<Window> create(const Options& options);
  ~Window() override;

  void make_current() override;
  /// GLFW's handle, for ImGui's GLFW backend. Never null.
  [[nodiscard]] GLFWwindow* handle() const noexcept { return handle_; }
  /// Size in pixels, not screen coordinates. 0 x 0 while minimised.
  [[nodiscard]] Extent framebuffer_size() const;
  /// The monitor's scale for text and widgets: 1 ordinary, 2 HiDPI.
  [[nodiscard]] float content_scale() const;
  [[nodiscard]] bool should_close() const;
  /// Asks for closing (true) or takes the request back (false).
  void set_should_close(bool close);
  void set_title(const std::string& title);
  void set_full_screen(bool full);
  [[nodiscard]] bool full_screen() const noexcept { return full_screen_; }
  /// Shows the content of the default framebuffer.
  void swap();
  /// Handles pending events; waits for one at most `seconds` (0: does not wait; infinity: until one comes).
  void wait_events(double seconds);
  /// Ends a waiting wait_events, from any thread.
  static void wake();
  /// Calls `hook` with the files dropped on the window, on the main thread, inside wait_events.
  void on_drop(std::function<void(std::vector<std::filesystem::path>)> hook);

 private:
  Window() = default;
  GLFWwindow* handle_ = nullptr;
  bool full_screen_ = false;
  int restore_[4] = {0, 0, 0, 0};  // x, y, width, height before full screen
  std::function<void(std::vector<std::filesystem::path>)> drop_;
  friend struct WindowHooks;
};

/// True when a window could be opened here as far as the environment tells (DISPLAY or WAYLAND_DISPLAY).
[[nodiscard]] bool has_display();

}  // namespace dmoscope::render
