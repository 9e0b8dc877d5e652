#include "app/window/desktop.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "app/window/window.h"
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

namespace {

ui::App::Options options_of(const WindowOptions& options, const render::Context& context) {
  ui::App::Options app = app_options(options.threads, options.backend, acceleration_for(options.backend), context);
  app.native_dialogs = !options.scripted;
  return app;
}

}  // namespace

Desktop::Desktop(const WindowOptions& options)
    : options_(options), window_(render::Window::create({})), input_(window_->handle(), keys_), app_(options_of(options, *window_)) {
  ui::ViewState& state = app_.state();
  app_.engine().set_report_writer(options_.report);
  if (!options_.scripted) begin_as_remembered();
  begin_autosave();
  if (options_.scale > 0.0) state.scale = options_.scale;
  app_.set_wake([] { render::Window::wake(); });
  app_.set_listener([this](const Message& message) {
    if (!options_.scripted) return;
    said_.push_back(message);
    if (message.kind == Message::Kind::Error && !failure_) failure_ = message;
  });
  const render::Extent size = window_->framebuffer_size();
  state.window_size = {size.width, size.height};
  window_->on_drop([this](const std::vector<std::filesystem::path>& files) { open(files, true); });
  open(options_.files, false);
}

/// Opens files: the first replaces what is open, the others are shown beside it.
void Desktop::open(const std::vector<std::filesystem::path>& files, bool by_person) {
  for (const std::string& command : ui::open_commands(files)) {
    if (!by_person) {
      app_.submit(command);
    } else if (app_.state().leaving) {
      ui::add_message(app_.state(), {Message::Kind::Warning, command + ": waits for the question to be answered; drop it again", 0});
    } else {
      app_.submit_by_person(command);
    }
  }
}

/// Restores the settings, the window's size among them.
void Desktop::begin_as_remembered() {
  ui::ViewState& state = app_.state();
  ui::move_to_monitor(state, static_cast<double>(window_->content_scale()));
  state.stepping.flash = ui::Flash::On;  // default of the window; pictures of scripts must not depend on the time
  state.pointer_value = true;
  settings_.begin(ui::settings_path(), ui::recent_path(), state);
  state.asks_unsaved = true;
  state.tour.offer = !state.tour.offered;
  if (state.place.width <= 0) return;
  int x = 0, y = 0, width = state.place.width, height = state.place.height;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor(); monitor != nullptr) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  // The monitor may be smaller than last time.
  glfwSetWindowSize(window_->handle(), std::min(state.place.width, width), std::min(state.place.height, height));
  if (state.place.maximised) glfwMaximizeWindow(window_->handle());
}

/// Begins to save automatically, by default in an interactive window alone; DMOSCOPE_AUTOSAVE is the interval in seconds (0: never), also
/// for scripts.
void Desktop::begin_autosave() {
  AutosaveOptions options{ui::autosave_folder()};
  const char* wish = std::getenv("DMOSCOPE_AUTOSAVE");
  if (options.folder.empty() || (options_.scripted && wish == nullptr)) return;
  if (wish != nullptr) {
    constexpr double kMost = 1e6, kThousand = 1e3;
    const double seconds = std::strtod(wish, nullptr);
    if (!(seconds > 0.0)) return;
    options.every = std::chrono::milliseconds(std::max(1L, std::lround(std::min(seconds, kMost) * kThousand)));
  }
  if (!options_.scripted) app_.state().recoverable = find_recoverable(options.folder);
  try {
    app_.engine().autosave(std::move(options));
  } catch (const Error& error) {
    ui::add_message(app_.state(), {Message::Kind::Warning, fmt::format("nothing is saved by itself: {}", error.what()), 0});
  }
}

Desktop::~Desktop() {
  if (!options_.scripted)
    for (const std::string& trouble : settings_.write(app_.state())) complain(trouble);
  app_.engine().cancel();
  if (options_.scripted && std::uncaught_exceptions() == 0) app_.engine().end_autosave();
  app_.set_wake({});
}

double Desktop::now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void Desktop::run_until_closed() {
  while (!app_.state().requests.quit && !ending_) {
    wait();
    if (window_->should_close()) ask_to_close();
    frame();
  }
  app_.engine().cancel();
  if (!ending_) return app_.engine().end_autosave();
  constexpr std::chrono::seconds kPatience{10};
  app_.update_autosaved_view();
  (void)app_.engine().autosave_now(kPatience);  // on failure the state saved before remains
}

void Desktop::end_soon() {
  ending_ = true;
  render::Window::wake();
}

void Desktop::ask_to_close() {
  window_->set_should_close(false);
  if (glfwGetWindowAttrib(window_->handle(), GLFW_ICONIFIED) == GLFW_TRUE) glfwRestoreWindow(window_->handle());
  app_.submit_by_person("quit");
  frames_left_ = 4;
}

void Desktop::notice_place() {
  GLFWwindow* window = window_->handle();
  if (window_->full_screen() || glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE) return;
  ui::WindowPlace& place = app_.state().place;
  place.maximised = glfwGetWindowAttrib(window, GLFW_MAXIMIZED) == GLFW_TRUE;
  if (!place.maximised || place.width == 0) glfwGetWindowSize(window, &place.width, &place.height);
}

/// Sleeps until an event. Draws a few frames after it: ImGui needs two to settle, hovering some more.
void Desktop::wait() {
  constexpr int kFramesAfterEvent = 4;
  constexpr double kCaretBlink = 0.25;
  if (frames_left_ > 0 || keys_.waiting()) {
    frames_left_ = std::max(0, frames_left_ - 1);
    window_->wait_events(0.0);
    return;
  }
  const double before = now(), most = std::min({app_.redraw_in(), settings_in_, ImGui::GetIO().WantTextInput ? kCaretBlink : INFINITY});
  window_->wait_events(most);
  if (now() - before < most) frames_left_ = kFramesAfterEvent;
}

void Desktop::frame() {
  const render::Extent size = window_->framebuffer_size();
  constexpr double kPauseOfNothingSeen = 0.1;
  if (size.width == 0 || size.height == 0) return window_->wait_events(kPauseOfNothingSeen);
  if (!options_.scripted) ui::move_to_monitor(app_.state(), static_cast<double>(window_->content_scale()));
  if (app_.prepare()) interface_.upload_fonts();
  ImGui_ImplOpenGL3_NewFrame();
  input_.begin_frame(size);
  if (options_.scripted) {
    ImGuiIO& io = ImGui::GetIO();
    auto& input = app_.state().requests.input;
    if (!input.empty()) {
      simulated_.play(input.front(), io, keys_);
      input.pop_front();
    }
    simulated_.hold(io);
    constexpr float kPause = 0.5F;
    if (std::exchange(pause_, false)) io.DeltaTime += kPause;
  }
  keys_.feed(ImGui::GetIO(), app_);
  ImGui::NewFrame();
  app_.draw(now());
  ImGui::Render();
  render::Framebuffer::bind_default(size.width, size.height);
  interface_.draw();
  window_->swap();
  take_wishes(size);
  if (options_.scripted) return;
  notice_place();
  settings_in_ = settings_.look(app_.state(), now());
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
    const bool quiet = sized && app_.state().requests.input.empty() && !keys_.waiting() && app_.settled();
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
    if (app_.bring_to_sight(line)) settle();
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

int run_window(const WindowOptions& options) {
  require_display();
  block_interrupts();  // before other threads start
  Desktop window(options);
  const Watch watch([&window] { window.end_soon(); });  // a second signal ends the process at once
  window.run_until_closed();
  return 0;
}

}  // namespace dmoscope::app
