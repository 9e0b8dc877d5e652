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

/// One at a time (ImGui has one context).
class HeadlessWindow {
 public:
  struct Options {
    int width = 1280, height = 800;  // pixels
    double scale = 1.0;
    unsigned threads = 0;
    Backend backend = Backend::Auto;
    std::optional<Acceleration> acceleration{};  // none: this machine's
    std::optional<std::string> no_interop{};     // why that cannot write what is drawn; none: what this machine says
    bool native_dialogs = false;                 // see ui::App::Options
    bool sample_pictures = true;                 // see ui::App::Options
    bool explains = true;                        // what holds the minimum is worked out after every line
    bool as_on_screen = false;                   // nothing is waited for: neither the first frames nor a big mesh to be made ready
  };
  /// Throws Error where no OpenGL without a screen can be had.
  explicit HeadlessWindow(const Options& options);
  ~HeadlessWindow();

  [[nodiscard]] ui::App& app() noexcept { return *app_; }
  /// Draws one frame after playing at most one simulated input. The clock goes on by 1/60 s a frame, whatever it takes.
  void frame();
  /// Draws the interface of the frame before as a screen would get it, and waits until it is there.
  void present();
  /// Frames until input, session, scene and interface have come to rest.
  void settle();
  /// Executes one line as a script does, then settles. Returns the first error that came of it: of the line itself (thrown
  /// errors included), of the session, or of a screenshot.
  [[nodiscard]] std::optional<Message> run(std::string_view line);
  /// What was said while the last line ran, errors included.
  [[nodiscard]] const std::vector<Message>& said() const noexcept { return said_; }
  /// The window's pixels as drawn last.
  [[nodiscard]] render::Image picture();
  [[nodiscard]] const std::string& clipboard() const noexcept { return clipboard_; }
  /// What is typed into it comes with the next frames, as many keys between two as one likes.
  [[nodiscard]] KeyQueue& keys() noexcept { return keys_; }
  [[nodiscard]] bool quit() const { return app_->state().requests.quit; }

 private:
  void set_up_input();
  void take_wishes();

  Acceleration acceleration_;
  std::unique_ptr<render::Context> context_;
  std::unique_ptr<Interface> interface_;
  std::optional<render::Framebuffer> screen_;  // of present()
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
