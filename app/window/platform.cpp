#include "app/window/platform.h"

#include <new>
#include <utility>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/window/interop.h"

namespace dmoscope::app {

// ui has GLFW's numbers of keys, without including it.
static_assert(ui::key::kSpace == GLFW_KEY_SPACE && ui::key::kEscape == GLFW_KEY_ESCAPE && ui::key::kEnter == GLFW_KEY_ENTER);
static_assert(ui::key::kTab == GLFW_KEY_TAB && ui::key::kBackspace == GLFW_KEY_BACKSPACE && ui::key::kInsert == GLFW_KEY_INSERT);
static_assert(ui::key::kDelete == GLFW_KEY_DELETE && ui::key::kRight == GLFW_KEY_RIGHT && ui::key::kLeft == GLFW_KEY_LEFT);
static_assert(ui::key::kDown == GLFW_KEY_DOWN && ui::key::kUp == GLFW_KEY_UP && ui::key::kPageUp == GLFW_KEY_PAGE_UP);
static_assert(ui::key::kPageDown == GLFW_KEY_PAGE_DOWN && ui::key::kHome == GLFW_KEY_HOME && ui::key::kEnd == GLFW_KEY_END);
static_assert(ui::key::kF1 == GLFW_KEY_F1 && ui::key::kLeftShift == GLFW_KEY_LEFT_SHIFT && ui::key::kLeftControl == GLFW_KEY_LEFT_CONTROL);
static_assert(ui::key::kLeftAlt == GLFW_KEY_LEFT_ALT && GLFW_KEY_A == 'A' && GLFW_KEY_LEFT_BRACKET == '[');

Interface::Interface() {
  IMGUI_CHECKVERSION();
  context_ = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void Interface::upload_fonts() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Interface::draw() { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

render::Image Interface::picture(int width, int height) {
  render::Framebuffer target(width, height);
  target.clear({0, 0, 0, 255});
  draw();
  render::Image image = target.read_pixels();
  // Blending makes alpha less than one where the interface is translucent; a window is opaque.
  for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
  return image;
}

ui::App::Options app_options(unsigned threads, Backend backend, Acceleration acceleration, const render::Context& context) {
  ui::App::Options options;
  options.threads = threads;
  options.backend = backend;
  options.no_interop = no_interop(acceleration, context);
  options.acceleration = std::move(acceleration);
  options.renderer = context.description();
  options.software_renderer = context.is_software();
  return options;
}

std::optional<Message> take_screenshots(ui::App& app, Interface& interface, int width, int height) {
  std::optional<Message> failure;
  auto& wanted = app.state().requests.screenshots;
  while (!wanted.empty()) {
    const ui::ScreenshotOptions options = wanted.front();
    wanted.pop_front();
    Message message;
    try {
      const render::Image image = options.window ? interface.picture(width, height) : app.mesh_picture(options);
      render::write_png(options.path, image);
      if (options.quiet) continue;
      message = {Message::Kind::Info, fmt::format("saved {} ({} x {} pixels)", options.path.string(), image.width, image.height), 0};
    } catch (const Error& error) {
      message = {Message::Kind::Error, error.what(), error.exit_code()};
      if (!failure) failure = message;
      app.state().requests.screenshot_failed = true;
    } catch (const std::bad_alloc&) {
      message = {Message::Kind::Error, "not enough memory for a picture of this size", 3};
      if (!failure) failure = message;
      app.state().requests.screenshot_failed = true;
    }
    ui::add_message(app.state(), message);
  }
  return failure;
}

}  // namespace dmoscope::app
