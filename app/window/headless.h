#pragma once
// The window without a screen: the same App, a simulated mouse and keyboard, and a framebuffer instead of a monitor.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/window/platform.h"
#include "app/window/simulated_input.h"
#include "render/context.h"
#include "render/framebuffer.h"
#include "ui/app.h"

namespace dmoscope::app {

/// Window without a screen; only one at a time (ImGui has one context).
class HeadlessWindow {
 public:
  struct Options {
    int width = 1280, height = 800;  // pixels
    double scale = 1.0;
    unsigned threads = 0;
    Backend backend = Backend::Auto;
    std::optional<Acceleration> acceleration{};  // none: this machine's
    std::optional<std::string> no_interop{};     // why the accelerator cannot write what is drawn; none: detected
    bool native_dialogs = false;                 // see ui::App::Options
    bool sample_pictures = true;                 // see ui::App::Options
    bool explains = true;                        // whether the hold of the minimum is found after every line
    bool as_on_screen = false;                   // does not wait for the first frames, nor for a big mesh to be prepared
  };
  /// Makes the window. Throws Error if OpenGL is not available without a screen.
  explicit HeadlessWindow(const Options& options);
  ~HeadlessWindow();

  [[nodiscard]] ui::App& app() noexcept { return *app_; }
  /// Draws one frame after playing at most one simulated input. The clock advances by 1/60 s a frame.
  void frame();
  /// Draws the interface of the last frame as for a screen, and waits until that is done.
  void present();
  /// Draws frames until input, session, scene and interface have settled.
  void settle();
  /// Executes one line of a script, then settles. Returns the first error: of the line itself (thrown errors included), of the session, or
  /// of a screenshot.
  [[nodiscard]] std::optional<Message> run(std::string_view line);
  /// Messages of the last line, errors included.
  [[nodiscard]] const std::vector<Message>& said() const noexcept { return said_; }
  /// The window's pixels as drawn last.
  [[nodiscard]] render::Image picture();
  [[nodiscard]] const std::string& clipboard() const noexcept { return clipboard_; }
  /// Keyboard queue: keys that are put into it arrive with the next frames, any number between two.
  [[nodiscard]] KeyQueue& keys() noexcept { return keys_; }
  [[nodiscard]] bool quit() const { return app_->state().requests.quit; }

 private:
  void set_up_input();
  void take_wishes();

  Acceleration acceleration_;
  std::unique_ptr<render::Context> context_;
  std::unique_ptr<Interface> interface_;
  std::optional<render::Framebuffer> screen_;  // for present()
  std::unique_ptr<ui::App> app_;
  KeyQueue keys_;
  SimulatedInput simulated_;
  int width_, height_;
  double now_ = 0.0;
  bool pause_ = false;
  std::string clipboard_;
  std::vector<Message> said_;
  std::optional<Message> failure_;
};

}  // namespace dmoscope::app
