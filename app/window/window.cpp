#include "app/window/window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/window/platform.h"
#include "core/session/commands.h"
#include "render/window.h"
#include "ui/settings.h"

namespace dmoscope::app {
namespace {

/// GLFW's half of ImGui.
class GlfwInput {
 public:
  explicit GlfwInput(GLFWwindow* window) { ImGui_ImplGlfw_InitForOpenGL(window, true); }
  ~GlfwInput() { ImGui_ImplGlfw_Shutdown(); }
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;
};

class Desktop {
 public:
  explicit Desktop(const WindowOptions& options)
      : window_(render::Window::create({})),
        input_(window_->handle()),
        app_(app_options(options.threads, window_->description(), window_->is_software())) {
    ui::ViewState& state = app_.state();
    state.scale = static_cast<double>(window_->content_scale());
    ui::load_settings(settings_, state);
    if (options.scale > 0.0) state.scale = options.scale;
    app_.engine().set_wake([] { render::Window::wake(); });
    window_->on_drop([this](const std::vector<std::filesystem::path>& files) {
      for (const auto& file : files) app_.submit(fmt::format("open {}", quote_word(file.string())));
    });
    for (const auto& file : options.files) app_.submit(fmt::format("open {}", quote_word(file.string())));
    lines_.assign(options.commands.begin(), options.commands.end());
  }

  ~Desktop() {
    if (const std::string trouble = ui::save_settings(settings_, app_.state()); !trouble.empty())
      std::fprintf(stderr, "%s\n", trouble.c_str());
    app_.engine().cancel();
    app_.engine().set_wake({});
  }
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  void run() {
    while (!window_->should_close() && !app_.state().requests.quit) {
      wait();
      next_line();
      frame();
    }
  }

 private:
  [[nodiscard]] double now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  /// Sleeps until something happens. An event is followed by a few frames: ImGui needs two to settle, hovering some more.
  void wait() {
    constexpr int kFramesAfterEvent = 4;
    constexpr double kTooltipDelay = 1.0;
    if (frames_left_ > 0) {
      --frames_left_;
      window_->wait_events(0.0);
      return;
    }
    const double caret = ImGui::GetIO().WantTextInput ? 0.25 : kTooltipDelay * 3600;
    const double before = now(), most = std::min(app_.redraw_in(), caret);
    window_->wait_events(most);
    if (now() - before < most) frames_left_ = kFramesAfterEvent;
  }

  /// Commands given at the start go one after another, each when the one before it is done.
  void next_line() {
    if (lines_.empty() || app_.engine().busy() || !app_.settled()) return;
    app_.submit(lines_.front());
    lines_.pop_front();
    frames_left_ = 4;
  }

  void frame() {
    const render::Extent size = window_->framebuffer_size();
    if (size.width == 0 || size.height == 0) return;
    if (app_.prepare()) interface_.upload_fonts();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    app_.draw(now());
    ImGui::Render();
    render::Framebuffer::bind_default(size.width, size.height);
    interface_.draw();
    window_->swap();
    take_screenshots(app_, interface_, size.width, size.height);
    take_wishes();
  }

  void take_wishes() {
    ui::Requests& requests = app_.state().requests;
    if (requests.clipboard) ImGui::SetClipboardText(requests.clipboard->c_str());
    if (requests.full_screen) window_->set_full_screen(*requests.full_screen);
    requests.clipboard.reset();
    requests.full_screen.reset();
    requests.size.reset();  // a person's window keeps the size that the person gave it
    requests.input.clear();
    if (const std::string title = app_.title(); title != title_) window_->set_title(title_ = title);
  }

  std::unique_ptr<render::Window> window_;
  Interface interface_;
  GlfwInput input_;
  ui::App app_;
  std::filesystem::path settings_ = ui::settings_path();
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::deque<std::string> lines_;
  std::string title_;
  int frames_left_ = 4;
};

}  // namespace

int run_window(const WindowOptions& options) {
  if (!render::has_display()) {
    throw Error(
        "no display: neither DISPLAY nor WAYLAND_DISPLAY is set, so no window can be opened. Without one there are "
        "dmoscope smooth, quality, compare, render, convert, generate, script --headless, bench and info.");
  }
  Desktop(options).run();
  return 0;
}

}  // namespace dmoscope::app
