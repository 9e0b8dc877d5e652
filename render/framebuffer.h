#pragma once
// A picture on the OpenGL side that scenes (and ImGui) are drawn into.

#include "render/image.h"

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
  /// Likewise of the depths, as they lie in OpenGL's buffer: 0 to 1, where nothing was drawn 1.
  [[nodiscard]] unsigned depth_texture() const noexcept { return depth_; }
  /// Draws go here, all of it is the viewport.
  void bind();
  /// Draws go to the window's own framebuffer again (0).
  static void bind_default(int width, int height);
  /// Binds and fills: depth to its farthest.
  void clear(Rgba colour);
  /// Takes the size and the colours of another one; depth is left as it is.
  void copy_from(const Framebuffer& other);
  /// Takes the colours of the middle of a larger one.
  void copy_middle_of(const Framebuffer& larger);
  /// The picture, with straight alpha. Waits for OpenGL.
  [[nodiscard]] Image read_pixels() const;
  /// The largest width and height OpenGL allows here.
  [[nodiscard]] static int largest_size();

 private:
  void release() noexcept;
  void create();
  int width_ = 1, height_ = 1;
  unsigned framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

}  // namespace dmoscope::render
