#pragma once
// The window on a screen: the App, GLFW's events, and frames drawn when there is something new to see.

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/window/glfw_input.h"
#include "app/window/platform.h"
#include "app/window/simulated_input.h"
#include "app/window/window.h"
#include "ui/app.h"

namespace dmoscope::app {

/// Throws Error, which names the subcommands that need no screen, when there is no display.
void require_display();

class Desktop {
 public:
  /// Opens the window. Throws Error when OpenGL is too old.
  explicit Desktop(const WindowOptions& options);
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// The event loop.
  void run_until_closed();
  /// Executes one line as a script does, then handles events until all has come to rest. Returns the first error that came of
  /// it: of the line itself, of the session, of a screenshot, or that somebody closed the window.
  [[nodiscard]] std::optional<Message> run(std::string_view line);
  /// What was said while the last line ran, errors included.
  [[nodiscard]] const std::vector<Message>& said() const noexcept { return said_; }
  [[nodiscard]] bool quit() const { return window_->should_close() || app_.state().requests.quit; }

 private:
  [[nodiscard]] double now() const;
  void wait();
  void frame();
  void take_wishes(render::Extent size);
  void resize(std::pair<int, int> size);
  /// Frames until input, session, scene and window have come to rest, or the window is closed.
  void settle();
  [[nodiscard]] bool has_wanted_size() const;

  WindowOptions options_;
  std::unique_ptr<render::Window> window_;
  Interface interface_;
  GlfwInput input_;
  ui::App app_;
  std::filesystem::path settings_, recent_;  // empty: neither read nor written
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string title_;
  int frames_left_ = 4;

  // Scripts
  SimulatedInput simulated_;
  bool pause_ = false;  // before the next frame, so that two clicks are no double click
  std::optional<std::pair<int, int>> wanted_size_;
  std::vector<Message> said_;
  std::optional<Message> failure_;
};

}  // namespace dmoscope::app
