#pragma once
// The window on a screen: the App, GLFW's events, and frames drawn when the picture changes.

#include <atomic>
#include <chrono>
#include <cmath>
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
#include "ui/commands/settings.h"

namespace dmoscope::app {

/// Throws Error, which names the subcommands that need no screen, if there is no display.
void require_display();

class Desktop {
 public:
  /// Opens the window. Throws Error if OpenGL is too old.
  explicit Desktop(const WindowOptions& options);
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// Runs the event loop. Before the user closes the window, asks about work that is not saved.
  void run_until_closed();
  /// Ends the loop, on a signal, from any thread; unsaved work is kept for the next start.
  void end_soon();
  /// Executes one line of a script, then handles events until all has settled. Returns the first error: of the line itself, of the session,
  /// of a screenshot, or that the window was closed.
  [[nodiscard]] std::optional<Message> run(std::string_view line);
  /// Messages of the last line, errors included.
  [[nodiscard]] const std::vector<Message>& said() const noexcept { return said_; }
  [[nodiscard]] bool quit() const { return window_->should_close() || app_.state().requests.quit; }

 private:
  [[nodiscard]] double now() const;
  void open(const std::vector<std::filesystem::path>& files, bool by_person);
  void begin_as_remembered();
  void begin_autosave();
  void notice_place();
  void ask_to_close();
  void wait();
  void frame();
  void take_wishes(render::Extent size);
  void resize(std::pair<int, int> size);
  /// Draws frames until input, session, scene and window have settled, or the window is closed.
  void settle();
  [[nodiscard]] bool has_wanted_size() const;

  WindowOptions options_;
  std::unique_ptr<render::Window> window_;
  Interface interface_;
  KeyQueue keys_;
  GlfwInput input_;
  ui::App app_;
  ui::SettingsKeeper settings_;
  double settings_in_ = INFINITY;  // seconds until they may have to be saved
  std::atomic<bool> ending_{false};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string title_;
  int frames_left_ = 4;

  // State of scripts
  SimulatedInput simulated_;
  bool pause_ = false;  // before the next frame, so that two clicks are no double click
  std::optional<std::pair<int, int>> wanted_size_;
  std::vector<Message> said_;
  std::optional<Message> failure_;
};

}  // namespace dmoscope::app
