#pragma once
// Dear ImGui's context and its drawing, shared by the window and its twin without a screen.

#include <optional>

#include "render/context.h"
#include "render/framebuffer.h"
#include "render/image.h"
#include "ui/app.h"

struct ImGuiContext;

namespace dmoscope::app {

/// The one ImGui context, with the OpenGL backend. Needs a current OpenGL context.
class Interface {
 public:
  Interface();
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Uploads the fonts; to be called after App::prepare returned true.
  void upload_fonts();
  /// Draws the frame of ImGui::Render into the framebuffer that is bound.
  void draw();
  /// Draws the frame as a picture of `width` x `height` pixels.
  [[nodiscard]] render::Image picture(int width, int height);

 private:
  ImGuiContext* context_ = nullptr;
};

/// Options of App for this machine and the current OpenGL context.
[[nodiscard]] ui::App::Options app_options(unsigned threads, Backend backend, Acceleration acceleration, const render::Context& context);

/// Takes the requested screenshots of the last frame; an error becomes a message. Returns the first error, if any, for scripts.
std::optional<Message> take_screenshots(ui::App& app, Interface& interface, int width, int height);

}  // namespace dmoscope::app
