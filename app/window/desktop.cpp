#include "app/window/desktop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "core/commands/commands.h"
#include "ui/commands/settings.h"
#include "ui/toolkit/file_browser.h"

namespace dmoscope::app {

void require_display() {
  if (render::has_display()) return;
  throw Error(
      "no display: neither DISPLAY nor WAYLAND_DISPLAY is set, so no window can be opened. Without one there are "
      "dmoscope smooth, compare, quality, render, convert, generate, script --headless, bench, paper and info.");
}

Desktop::Desktop(const WindowOptions& options)
    : options_(options),
      window_(render::Window::create({})),
      input_(window_->handle()),
      app_(app_options(options.threads, options.backend, acceleration_for(options.backend), *window_)) {
  ui::ViewState& state = app_.state();
  if (!options_.scripted) {
    ui::move_to_monitor(state, static_cast<double>(window_->content_scale()));
    settings_ = ui::settings_path();
    recent_ = ui::recent_path();
    state.stepping.flash = ui::Flash::On;  // unless the settings say otherwise; pictures of scripts stay the same whenever they are taken
    ui::load_settings(settings_, state);
    ui::load_recent(recent_, state);
  }
  if (options_.scale > 0.0) state.scale = options_.scale;
  app_.set_wake([] { render::Window::wake(); });
  app_.set_listener([this](const Message& message) {
    if (!options_.scripted) return;
    said_.push_back(message);
    if (message.kind == Message::Kind::Error && !failure_) failure_ = message;
  });
  const render::Extent size = window_->framebuffer_size();
  state.window_size = {size.width, size.height};
  const auto open = [this](const std::vector<std::filesystem::path>& files) {
    for (const std::string& command : ui::open_commands(files)) app_.submit(command);
  };
  window_->on_drop(open);
  open(options_.files);
}

Desktop::~Desktop() {
  for (const std::string& trouble : {ui::save_settings(settings_, app_.state()), ui::save_recent(recent_, app_.state())}) {
    if (!trouble.empty()) complain(trouble);
  }
  app_.engine().cancel();
  app_.set_wake({});
}

double Desktop::now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void Desktop::run_until_closed() {
  while (!quit()) {
    wait();
    frame();
  }
}

/// Sleeps until something happens. An event is followed by a few frames: ImGui needs two to settle, hovering some more.
void Desktop::wait() {
  constexpr int kFramesAfterEvent = 4;
  constexpr double kCaretBlink = 0.25;
  if (frames_left_ > 0 || input_.waiting()) {
    frames_left_ = std::max(0, frames_left_ - 1);
    window_->wait_events(0.0);
    return;
  }
  const double before = now(), most = std::min(app_.redraw_in(), ImGui::GetIO().WantTextInput ? kCaretBlink : INFINITY);
  window_->wait_events(most);
  if (now() - before < most) frames_left_ = kFramesAfterEvent;
}

void Desktop::frame() {
  const render::Extent size = window_->framebuffer_size();
  if (size.width == 0 || size.height == 0) return;
  if (!options_.scripted) ui::move_to_monitor(app_.state(), static_cast<double>(window_->content_scale()));
  if (app_.prepare()) interface_.upload_fonts();
  ImGui_ImplOpenGL3_NewFrame();
  input_.begin_frame(size);
  if (options_.scripted) {
    ImGuiIO& io = ImGui::GetIO();
    auto& input = app_.state().requests.input;
    if (!input.empty()) {
      simulated_.play(input.front(), io);
      input.pop_front();
    }
    simulated_.hold(io);
    constexpr float kPause = 0.5F;
    if (std::exchange(pause_, false)) io.DeltaTime += kPause;
  }
  ImGui::NewFrame();
  app_.draw(now());
  ImGui::Render();
  input_.end_frame();
  render::Framebuffer::bind_default(size.width, size.height);
  interface_.draw();
  window_->swap();
  take_wishes(size);
}

void Desktop::take_wishes(render::Extent size) {
  ui::Requests& requests = app_.state().requests;
  const std::optional<Message> failure = take_screenshots(app_, interface_, size.width, size.height);
  if (failure && !failure_) failure_ = failure;
  if (requests.clipboard) ImGui::SetClipboardText(requests.clipboard->c_str());
  requests.clipboard.reset();
  if (requests.full_screen) window_->set_full_screen(*requests.full_screen);
  requests.full_screen.reset();
  if (requests.size) resize(*requests.size);
  requests.size.reset();
  if (!options_.scripted && !requests.input.empty()) {
    requests.input.clear();
    ui::add_message(app_.state(), {Message::Kind::Error, "simulated mouse and keys are for scripts: dmoscope script FILE [--headless]", 2});
  }
  if (const std::string title = app_.title(); title != title_) window_->set_title(title_ = title);
}

void Desktop::resize(std::pair<int, int> size) {
  window_->set_full_screen(false);
  app_.state().full_screen = false;
  wanted_size_ = size;
  int width = 0, height = 0;
  glfwGetWindowSize(window_->handle(), &width, &height);
  const render::Extent pixels = window_->framebuffer_size();
  const auto to_screen = [](int wanted, int screen, int have) { return have == 0 ? wanted : std::max(1, wanted * screen / have); };
  glfwSetWindowSize(window_->handle(), to_screen(size.first, width, pixels.width), to_screen(size.second, height, pixels.height));
}

bool Desktop::has_wanted_size() const {
  return !wanted_size_ || window_->framebuffer_size() == render::Extent{wanted_size_->first, wanted_size_->second};
}

void Desktop::settle() {
  constexpr int kRestFrames = 3;  // windows find their size in two frames
  constexpr double kPatience = 2.0;
  const double begin = now();
  for (int rest = 0; rest < kRestFrames && !quit();) {
    const bool sized = has_wanted_size() || now() - begin > kPatience;
    const bool quiet = sized && app_.state().requests.input.empty() && app_.settled();
    if (app_.engine().busy()) {
      wait();
    } else {
      window_->wait_events(app_.state().requests.input.empty() ? 0.01 : 0.0);
    }
    frame();
    const bool at_rest = quiet && !app_.engine().busy() && std::isinf(app_.redraw_in());
    rest = at_rest ? rest + 1 : 0;
  }
}

std::optional<Message> Desktop::run(std::string_view line) {
  said_.clear();
  failure_.reset();
  wanted_size_.reset();
  pause_ = true;
  try {
    app_.execute(line);
  } catch (const Error& error) {
    return Message{Message::Kind::Error, error.what(), error.exit_code()};
  }
  settle();
  if (window_->should_close()) return Message{Message::Kind::Error, "the window was closed before the script came to its end", 1};
  if (!failure_ && !has_wanted_size()) {
    failure_ = Message{Message::Kind::Error, "the window cannot have this size on this screen; script --headless draws any size", 1};
  }
  return failure_;
}

}  // namespace dmoscope::app
