#pragma once
// Thin owners of OpenGL objects; every call that can fail is checked. Only for sources of this module.

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>

#include <glad/gl.h>

#include "core/base/vec.h"

namespace dmoscope::render {

/// Throws Error with the call, its place and OpenGL's error if there is one.
void check_gl(const char* call, const char* file, int line);

/// An OpenGL object name with the function that deletes it.
template <class Deleter>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id) : id_(id) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = 0; }
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = other.id_;
      other.id_ = 0;
    }
    return *this;
  }
  [[nodiscard]] GLuint id() const noexcept { return id_; }

 private:
  void reset() noexcept {
    if (id_ != 0) Deleter{}(id_);
    id_ = 0;
  }
  GLuint id_ = 0;
};

struct DeleteBuffer {
  void operator()(GLuint id) const { glDeleteBuffers(1, &id); }
};
struct DeleteVertexArray {
  void operator()(GLuint id) const { glDeleteVertexArrays(1, &id); }
};
struct DeleteTexture {
  void operator()(GLuint id) const { glDeleteTextures(1, &id); }
};
struct DeleteFramebuffer {
  void operator()(GLuint id) const { glDeleteFramebuffers(1, &id); }
};
struct DeleteShader {
  void operator()(GLuint id) const { glDeleteShader(id); }
};
struct DeleteProgram {
  void operator()(GLuint id) const { glDeleteProgram(id); }
};

/// A buffer that grows when it must and is otherwise written in place.
class Buffer {
 public:
  /// Allocates again, losing the content, unless `bytes` fit already.
  void reserve(std::size_t bytes);
  /// Replaces the first bytes by `data`; memory is allocated anew only when it does not fit.
  void write(std::span<const std::byte> data);
  /// Replaces the bytes from `offset` on; they must fit.
  void write_at(std::size_t offset, std::span<const std::byte> data);
  template <class T>
  void write(std::span<const T> values) {
    write(std::as_bytes(values));
  }
  void bind_storage(GLuint binding) const;
  [[nodiscard]] GLuint id() const noexcept { return handle_.id(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

 private:
  Handle<DeleteBuffer> handle_;
  std::size_t capacity_ = 0;
};

/// Names of the shaders' files; `geometry` may be empty.
struct Stages {
  std::string_view vertex, geometry, fragment;
};

/// Macros set to 1 in all stages of a program.
using Defines = std::initializer_list<std::string_view>;

/// A linked program made of embedded shaders; "common.glsl" is put before each, and lines `#include "FILE"` stand for other files.
class Program {
 public:
  /// Compiles and links the shaders. Throws Error with the compiler's log.
  explicit Program(const Stages& stages, Defines defines = {});
  void use() const;
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;
  void set(const char* name, unsigned value) const;
  void set(const char* name, Vec2<float> value) const;
  void set(const char* name, float r, float g, float b, float a) const;
  /// Sets a 4 x 4 matrix, column after column.
  void set(const char* name, const std::array<float, 16>& matrix) const;

 private:
  [[nodiscard]] GLint location(const char* name) const;
  Handle<DeleteProgram> program_;
};

}  // namespace dmoscope::render

#define DMOSCOPE_GL(call)                                    \
  do {                                                       \
    call;                                                    \
    ::dmoscope::render::check_gl(#call, __FILE__, __LINE__); \
  } while (false)
