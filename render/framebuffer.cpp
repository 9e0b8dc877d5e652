#include "render/framebuffer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "render/gl.h"

namespace dmoscope::render {

Framebuffer::Framebuffer(int width, int height) : width_(std::max(width, 1)), height_(std::max(height, 1)) {
  try {
    create();
  } catch (...) {
    release();
    throw;
  }
}

Framebuffer::~Framebuffer() { release(); }

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : width_(other.width_),
      height_(other.height_),
      framebuffer_(std::exchange(other.framebuffer_, 0)),
      colour_(std::exchange(other.colour_, 0)),
      depth_(std::exchange(other.depth_, 0)) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
  if (this == &other) return *this;
  release();
  width_ = other.width_;
  height_ = other.height_;
  framebuffer_ = std::exchange(other.framebuffer_, 0);
  colour_ = std::exchange(other.colour_, 0);
  depth_ = std::exchange(other.depth_, 0);
  return *this;
}

void Framebuffer::release() noexcept {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (colour_ != 0) glDeleteTextures(1, &colour_);
  if (depth_ != 0) glDeleteTextures(1, &depth_);
  framebuffer_ = colour_ = depth_ = 0;
}

void Framebuffer::create() {
  if (std::max(width_, height_) > largest_size()) {
    throw Error(
        fmt::format("OpenGL here draws pictures of at most {0} x {0} pixels, asked for {1} x {2}", largest_size(), width_, height_));
  }
  DMOSCOPE_GL(glCreateTextures(GL_TEXTURE_2D, 1, &colour_));
  DMOSCOPE_GL(glTextureStorage2D(colour_, 1, GL_RGBA8, width_, height_));
  glTextureParameteri(colour_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(colour_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(colour_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(colour_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  DMOSCOPE_GL(glCreateTextures(GL_TEXTURE_2D, 1, &depth_));
  DMOSCOPE_GL(glTextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT24, width_, height_));
  glTextureParameteri(depth_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(depth_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  DMOSCOPE_GL(glCreateFramebuffers(1, &framebuffer_));
  DMOSCOPE_GL(glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0));
  DMOSCOPE_GL(glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0));
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error(fmt::format("OpenGL: framebuffer {} x {} is not complete (0x{:04x})", width_, height_, status));
}

void Framebuffer::resize(int width, int height) {
  width = std::max(width, 1);
  height = std::max(height, 1);
  if (width == width_ && height == height_) return;
  *this = Framebuffer(width, height);
}

void Framebuffer::bind() {
  DMOSCOPE_GL(glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_));
  glViewport(0, 0, width_, height_);
}

void Framebuffer::bind_default(int width, int height) {
  DMOSCOPE_GL(glBindFramebuffer(GL_FRAMEBUFFER, 0));
  glViewport(0, 0, width, height);
}

void Framebuffer::clear(Rgba colour) {
  bind();
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  const float alpha = static_cast<float>(colour.a) / 255.0F;
  const auto channel = [&](std::uint8_t value) { return static_cast<float>(value) / 255.0F * alpha; };
  const GLfloat premultiplied[] = {channel(colour.r), channel(colour.g), channel(colour.b), alpha};
  const GLfloat farthest = 1.0F;
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, premultiplied);
  DMOSCOPE_GL(glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &farthest));
}

void Framebuffer::copy_from(const Framebuffer& other) {
  resize(other.width_, other.height_);
  DMOSCOPE_GL(glCopyImageSubData(other.colour_, GL_TEXTURE_2D, 0, 0, 0, 0, colour_, GL_TEXTURE_2D, 0, 0, 0, 0, width_, height_, 1));
}

void Framebuffer::copy_middle_of(const Framebuffer& larger) {
  const int x = (larger.width_ - width_) / 2, y = (larger.height_ - height_) / 2;
  DMOSCOPE_GL(glCopyImageSubData(larger.colour_, GL_TEXTURE_2D, 0, x, y, 0, colour_, GL_TEXTURE_2D, 0, 0, 0, 0, width_, height_, 1));
}

Image Framebuffer::read_pixels() const {
  Image image(width_, height_);
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(height_));
  GLint pack = 4;
  glGetIntegerv(GL_PACK_ALIGNMENT, &pack);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  DMOSCOPE_GL(glGetTextureImage(colour_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(pixels.size()), pixels.data()));
  glPixelStorei(GL_PACK_ALIGNMENT, pack);
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* from = pixels.data() + row * static_cast<std::size_t>(height_ - 1 - y);
    std::uint8_t* to = image.rgba.data() + row * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < row; x += 4) {
      const unsigned alpha = from[x + 3];
      for (std::size_t c = 0; c < 3; ++c) {
        to[x + c] = alpha == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(std::min(255U, (from[x + c] * 255U + alpha / 2) / alpha));
      }
      to[x + 3] = static_cast<std::uint8_t>(alpha);
    }
  }
  return image;
}

int Framebuffer::largest_size() {
  GLint texture = 0, viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  return std::min({texture, viewport[0], viewport[1]});
}

TargetGuard::TargetGuard() {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
  glGetIntegerv(GL_VIEWPORT, viewport_);
}

TargetGuard::~TargetGuard() {
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

Vec2<double> size_of(const Framebuffer& target) { return {static_cast<double>(target.width()), static_cast<double>(target.height())}; }

void clear(Framebuffer& target, const Style& style) {
  target.clear(style.transparent ? Rgba{0, 0, 0, 0} : Rgba{style.background.r, style.background.g, style.background.b, 255});
}

void begin_elements() {
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
}
void begin_marks() {
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace dmoscope::render
