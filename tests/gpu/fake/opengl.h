#pragma once
// Real OpenGL for the stand-ins, drawn off screen by this machine.

#include <memory>
#include <vector>

#include <glad/egl.h>
#include <glad/gl.h>

#include "core/base/error.h"
#include "render/context.h"
#include "tests/gpu/fake/fixture.h"

namespace dmoscope::gpu::fake {

class HeadlessGl final : public OpenGl {
 public:
  const void* current_context() override { return eglGetCurrentContext(); }
  std::optional<std::size_t> size_of(std::uint32_t buffer) override {
    if (glIsBuffer(buffer) != GL_TRUE) return std::nullopt;
    GLint64 bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &bytes);
    return static_cast<std::size_t>(bytes);
  }
  /// Writes through another buffer, since this one may be of a kind that the processor does not write.
  void write(std::uint32_t buffer, std::span<const std::byte> content) override {
    GLuint staging = 0;
    const auto bytes = static_cast<GLsizeiptr>(content.size());
    glCreateBuffers(1, &staging);
    glNamedBufferStorage(staging, bytes, content.data(), 0);
    glCopyNamedBufferSubData(staging, buffer, 0, 0, bytes);
    glDeleteBuffers(1, &staging);
  }
};

/// Two buffers of OpenGL, of a picture's points and shades.
class Drawn {
 public:
  Drawn(std::size_t points, std::size_t shades) : point_count_(points), shade_count_(shades) {
    glCreateBuffers(2, names_);
    const std::vector<std::byte> nothing(std::max(points * 8, shades * 4), std::byte{0xab});
    glNamedBufferStorage(names_[0], static_cast<GLsizeiptr>(points * 8), nothing.data(), 0);
    glNamedBufferStorage(names_[1], static_cast<GLsizeiptr>(shades * 4), nothing.data(), 0);
  }
  ~Drawn() { glDeleteBuffers(2, names_); }
  Drawn(const Drawn&) = delete;
  Drawn& operator=(const Drawn&) = delete;
  [[nodiscard]] std::uint32_t points_name() const { return names_[0]; }
  [[nodiscard]] std::uint32_t shades_name() const { return names_[1]; }
  [[nodiscard]] std::vector<Vec2<float>> points() const {
    std::vector<Vec2<float>> read(point_count_);
    glGetNamedBufferSubData(names_[0], 0, static_cast<GLsizeiptr>(point_count_ * 8), read.data());
    return read;
  }
  [[nodiscard]] std::vector<float> shades() const {
    std::vector<float> read(shade_count_);
    glGetNamedBufferSubData(names_[1], 0, static_cast<GLsizeiptr>(shade_count_ * 4), read.data());
    return read;
  }

 private:
  std::size_t point_count_, shade_count_;
  GLuint names_[2] = {0, 0};
};

class WithOpenGl : public OnStandIns {
 protected:
  void SetUp() override {
    try {
      context = render::create_headless_context();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    set_up({.gl = &gl});
  }
  void TearDown() override {
    OnStandIns::TearDown();
    set_up({});
  }
  HeadlessGl gl;
  std::unique_ptr<render::Context> context;
};

}  // namespace dmoscope::gpu::fake
