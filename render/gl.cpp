#include "render/gl.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "render/shaders.h"

namespace dmoscope::render {
namespace {

std::string_view error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of graphics memory";
    default:
      return "unknown error";
  }
}

/// Text of a shader with every line `#include "FILE"` replaced by that file's text.
std::string whole_text(std::string_view file) {
  std::string text(shader_text(file));
  if (text.empty()) throw Error(fmt::format("the program holds no shader '{}'", file));
  constexpr std::string_view kInclude = "#include \"";
  for (std::size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at)) {
    const std::size_t name = at + kInclude.size(), end = text.find('"', name);
    text.replace(at, end + 1 - at, whole_text(text.substr(name, end - name)));
  }
  return text;
}

Handle<DeleteShader> compile(GLenum stage, std::string_view file, Defines defines) {
  const std::string text = whole_text(file);
  const std::string_view common = shader_text("common.glsl");
  std::string head = "#version 450 core\n";
  for (const std::string_view define : defines) head += fmt::format("#define {} 1\n", define);
  const GLchar* const parts[] = {head.data(), common.data(), text.data()};
  const GLint lengths[] = {static_cast<GLint>(head.size()), static_cast<GLint>(common.size()), static_cast<GLint>(text.size())};
  Handle<DeleteShader> shader(glCreateShader(stage));
  if (shader.id() == 0) throw Error(fmt::format("glCreateShader failed for {}", file));
  DMOSCOPE_GL(glShaderSource(shader.id(), 3, parts, lengths));
  DMOSCOPE_GL(glCompileShader(shader.id()));
  GLint good = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &good);
  if (good != GL_TRUE) {
    std::vector<char> log(8192, '\0');
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw Error(fmt::format("OpenGL does not compile {}: {}", file, log.data()));
  }
  return shader;
}

}  // namespace

void check_gl(const char* call, const char* file, int line) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw Error(fmt::format("OpenGL: {} (0x{:04x}) in {} ({}:{})", error_name(error), error, call, file, line));
}

void Buffer::reserve(std::size_t bytes) {
  if (handle_.id() != 0 && bytes <= capacity_) return;
  GLuint id = 0;
  DMOSCOPE_GL(glCreateBuffers(1, &id));
  handle_ = Handle<DeleteBuffer>(id);
  capacity_ = std::max<std::size_t>(bytes, 16);
  DMOSCOPE_GL(glNamedBufferStorage(id, static_cast<GLsizeiptr>(capacity_), nullptr, GL_DYNAMIC_STORAGE_BIT));
}

void Buffer::write(std::span<const std::byte> data) {
  reserve(data.size());
  if (!data.empty()) DMOSCOPE_GL(glNamedBufferSubData(handle_.id(), 0, static_cast<GLsizeiptr>(data.size()), data.data()));
}

void Buffer::write_at(std::size_t offset, std::span<const std::byte> data) {
  if (!data.empty())
    DMOSCOPE_GL(glNamedBufferSubData(handle_.id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()), data.data()));
}

void Buffer::bind_storage(GLuint binding) const { DMOSCOPE_GL(glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.id())); }

Program::Program(const Stages& stages, Defines defines) : program_(glCreateProgram()) {
  if (program_.id() == 0) throw Error("glCreateProgram failed");
  std::vector<Handle<DeleteShader>> shaders;
  const auto add = [&](GLenum stage, std::string_view file) {
    if (file.empty()) return;
    shaders.push_back(compile(stage, file, defines));
    DMOSCOPE_GL(glAttachShader(program_.id(), shaders.back().id()));
  };
  add(GL_VERTEX_SHADER, stages.vertex);
  add(GL_GEOMETRY_SHADER, stages.geometry);
  add(GL_FRAGMENT_SHADER, stages.fragment);
  DMOSCOPE_GL(glLinkProgram(program_.id()));
  GLint good = GL_FALSE;
  glGetProgramiv(program_.id(), GL_LINK_STATUS, &good);
  if (good != GL_TRUE) {
    std::vector<char> log(8192, '\0');
    glGetProgramInfoLog(program_.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw Error(fmt::format("OpenGL does not link {}: {}", stages.vertex, log.data()));
  }
  for (const Handle<DeleteShader>& shader : shaders) glDetachShader(program_.id(), shader.id());
}

void Program::use() const { DMOSCOPE_GL(glUseProgram(program_.id())); }

// OpenGL returns -1 for a uniform that the compiler left out because nothing reads it, and ignores its value.
GLint Program::location(const char* name) const { return glGetUniformLocation(program_.id(), name); }
void Program::set(const char* name, float value) const { glProgramUniform1f(program_.id(), location(name), value); }
void Program::set(const char* name, int value) const { glProgramUniform1i(program_.id(), location(name), value); }
void Program::set(const char* name, unsigned value) const { glProgramUniform1ui(program_.id(), location(name), value); }
void Program::set(const char* name, Vec2<float> value) const { glProgramUniform2f(program_.id(), location(name), value.x, value.y); }
void Program::set(const char* name, float r, float g, float b, float a) const {
  glProgramUniform4f(program_.id(), location(name), r, g, b, a);
}
void Program::set(const char* name, const std::array<float, 16>& matrix) const {
  glProgramUniformMatrix4fv(program_.id(), location(name), 1, GL_FALSE, matrix.data());
}

}  // namespace dmoscope::render
