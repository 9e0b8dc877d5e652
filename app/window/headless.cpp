#include "app/window/headless.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "app/common/acceleration.h"
#include "app/window/interop.h"

namespace dmoscope::app {
namespace {

constexpr float kFrameTime = 1.0F / 60.0F;
constexpr float kPause = 0.5F;  // between two lines, so that two clicks are no double click

}  // namespace

HeadlessWindow::HeadlessWindow(const Options& options)
    : acceleration_(options.acceleration ? *options.acceleration : acceleration_for(options.backend)),
      context_(headless_context_for(acceleration_)),
      interface_(std::make_unique<Interface>()),
      width_(options.width),
      height_(options.height) {
  set_up_input();
  ui::App::Options app = app_options(options.threads, options.backend, acceleration_, *context_);
  if (options.no_interop) app.no_interop = *options.no_interop;
  app.wait_for_scene = !options.as_on_screen;
  app.sample_pictures = options.sample_pictures;
  app.native_dialogs = options.native_dialogs;
  app_ = std::make_unique<ui::App>(std::move(app));
  app_->state().scale = options.scale;
  if (!options.explains) app_->engine().rest_without_long_work();
  app_->set_listener([this](const Message& message) {
    said_.push_back(message);
    if (message.kind == Message::Kind::Error && !failure_) failure_ = message;
  });
  if (!options.as_on_screen) settle();
}

HeadlessWindow::~HeadlessWindow() {
  app_.reset();
  screen_.reset();
  interface_.reset();
}

void HeadlessWindow::set_up_input() {
  ImGuiIO& io = ImGui::GetIO();
  const auto map = [&io](ImGuiKey what, int code) { io.KeyMap[what] = code; };
  namespace key = ui::key;
  map(ImGuiKey_Tab, key::kTab);
  map(ImGuiKey_LeftArrow, key::kLeft);
  map(ImGuiKey_RightArrow, key::kRight);
  map(ImGuiKey_UpArrow, key::kUp);
  map(ImGuiKey_DownArrow, key::kDown);
  map(ImGuiKey_PageUp, key::kPageUp);
  map(ImGuiKey_PageDown, key::kPageDown);
  map(ImGuiKey_Home, key::kHome);
  map(ImGuiKey_End, key::kEnd);
  map(ImGuiKey_Insert, key::kInsert);
  map(ImGuiKey_Delete, key::kDelete);
  map(ImGuiKey_Backspace, key::kBackspace);
  map(ImGuiKey_Space, key::kSpace);
  map(ImGuiKey_Enter, key::kEnter);
  map(ImGuiKey_Escape, key::kEscape);
  for (const auto& [what, letter] :
       {std::pair{ImGuiKey_A, 'A'}, {ImGuiKey_C, 'C'}, {ImGuiKey_V, 'V'}, {ImGuiKey_X, 'X'}, {ImGuiKey_Y, 'Y'}, {ImGuiKey_Z, 'Z'}}) {
    map(what, letter);
  }
  io.ClipboardUserData = this;
  io.SetClipboardTextFn = [](void* self, const char* text) { static_cast<HeadlessWindow*>(self)->clipboard_ = text; };
  io.GetClipboardTextFn = [](void* self) { return static_cast<HeadlessWindow*>(self)->clipboard_.c_str(); };
}

void HeadlessWindow::frame() {
  ImGuiIO& io = ImGui::GetIO();
  auto& input = app_->state().requests.input;
  if (!input.empty()) {
    simulated_.play(input.front(), io, keys_);
    input.pop_front();
  }
  simulated_.hold(io);
  if (app_->prepare()) interface_->upload_fonts();
  io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
  const float passed = pause_ ? kPause : kFrameTime;
  pause_ = false;
  io.DeltaTime = passed;
  ImGui_ImplOpenGL3_NewFrame();
  keys_.feed(io, *app_);
  ImGui::NewFrame();
  app_->draw(now_);
  ImGui::Render();
  now_ += static_cast<double>(passed);
  take_wishes();
}

void HeadlessWindow::present() {
  if (!screen_) screen_.emplace(width_, height_);
  screen_->resize(width_, height_);
  screen_->clear({0, 0, 0, 255});
  interface_->draw();
  context_->finish();
}

void HeadlessWindow::take_wishes() {
  ui::Requests& requests = app_->state().requests;
  if (const auto failure = take_screenshots(*app_, *interface_, width_, height_)) {
    said_.push_back(*failure);
    if (!failure_) failure_ = failure;
  }
  if (requests.clipboard) ImGui::SetClipboardText(requests.clipboard->c_str());
  requests.clipboard.reset();
  if (requests.size) std::tie(width_, height_) = *requests.size;
  requests.size.reset();
  requests.full_screen.reset();
}

void HeadlessWindow::settle() {
  constexpr int kRestFrames = 3;  // windows find their size in two frames
  int rest = 0;
  while (rest < kRestFrames) {
    app_->engine().wait_idle();
    const bool quiet = app_->state().requests.input.empty() && !keys_.waiting() && app_->settled();
    frame();
    rest = quiet && !app_->engine().busy() ? rest + 1 : 0;
  }
  // Full detail returns some time after the last movement.
  for (int k = 0; k < 600 && app_->redraw_in() < 1e9; ++k) frame();
}

std::optional<Message> HeadlessWindow::run(std::string_view line) {
  said_.clear();
  failure_.reset();
  pause_ = true;
  // A screenshot shows a settled scene, which every line leaves.
  try {
    if (app_->bring_to_sight(line)) settle();
    app_->execute(line);
  } catch (const Error& error) {
    const Message message{Message::Kind::Error, error.what(), error.exit_code()};
    said_.push_back(message);
    return message;
  }
  settle();
  return failure_;
}

render::Image HeadlessWindow::picture() { return interface_->picture(width_, height_); }

}  // namespace dmoscope::app
