#pragma once
// A picture on the OpenGL side, drawn into by scenes and ImGui.

#include "core/base/vec.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/style.h"

namespace dmoscope::render {

/// Colour (RGBA8, premultiplied alpha) and depth. Throws Error when OpenGL refuses.
class Framebuffer {
 public:
  Framebuffer(int width, int height);
  ~Framebuffer();
  Framebuffer(Framebuffer&& other) noexcept;
  Framebuffer& operator=(Framebuffer&& other) noexcept;

  /// Does nothing when the size is the same already; else the contents are lost. Sizes below 1 become 1.
  void resize(int width, int height);
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  /// OpenGL's name of the colour texture, for ImGui::Image: reinterpret_cast<ImTextureID>(std::uintptr_t{texture()}), with
  /// uv0 = (0, 1) and uv1 = (1, 0), because its first row is the bottom one.
  [[nodiscard]] unsigned texture() const noexcept { return colour_; }
  /// OpenGL's name of the texture of depths, as they lie in OpenGL's buffer: 0 to 1, and 1 when nothing was drawn.
  [[nodiscard]] unsigned depth_texture() const noexcept { return depth_; }
  /// Makes this the target of draws, with all of it as the viewport.
  void bind();
  /// Makes the window's own framebuffer (0) the target of draws again.
  static void bind_default(int width, int height);
  /// Binds and fills with a colour; depth is set to its farthest.
  void clear(Rgba colour);
  /// Takes the size and the colours of another one; depth is left as it is.
  void copy_from(const Framebuffer& other);
  /// Takes the colours of the middle of a larger one.
  void copy_middle_of(const Framebuffer& larger);
  /// The picture, with straight alpha. Waits for OpenGL.
  [[nodiscard]] Image read_pixels() const;
  /// The largest width and height that OpenGL allows here.
  [[nodiscard]] static int largest_size();

 private:
  void release() noexcept;
  void create();
  int width_ = 1, height_ = 1;
  unsigned framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

/// Keeps and restores what a draw changes and others may rely on: the bound framebuffer and the viewport.
class TargetGuard {
 public:
  TargetGuard();
  ~TargetGuard();
  TargetGuard(const TargetGuard&) = delete;
  TargetGuard& operator=(const TargetGuard&) = delete;

 private:
  GLint draw_ = 0, read_ = 0, viewport_[4] = {0, 0, 0, 0};
};

/// Width and height in pixels.
[[nodiscard]] Vec2<double> size_of(const Framebuffer& target);
/// Fills the target with the background.
void clear(Framebuffer& target, const Style& style);
/// Sets the state for elements: from here on they cover each other by depth.
void begin_elements();
/// Sets the state for marks: from here on they are blended over each other.
void begin_marks();

}  // namespace dmoscope::render
