#include "render/context.h"

#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <glad/gl.h>

#include "core/base/error.h"
#include "core/base/terminal_text.h"

namespace dmoscope::render {
namespace {

std::string text_of(GLenum what) {
  const GLubyte* text = glGetString(what);
  return text == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(text));
}

#ifndef NDEBUG
void GLAD_API_PTR print_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*) {
  if (severity != GL_DEBUG_SEVERITY_NOTIFICATION) fmt::print(stderr, "OpenGL: {}\n", terminal_line(message));
}
#endif

}  // namespace

void Context::finish() { glFinish(); }

void Context::adopt(const std::string& origin) {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  const std::string renderer = text_of(GL_RENDERER);
  if (major * 10 + minor < 45) {
    throw Error(
        fmt::format("OpenGL 4.5 is needed, but {} offers {}.{}; a newer graphics driver (for Mesa: package libgl1-mesa-dri) may have it",
                    renderer, major, minor));
  }
  description_ = fmt::format("OpenGL {}.{}, {}, {}", major, minor, renderer, origin);
  software_ = false;
  for (const std::string_view word : {"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"}) {
    if (renderer.find(word) != std::string::npos) software_ = true;
  }
#ifndef NDEBUG
  if (GLAD_GL_KHR_debug != 0 || major * 10 + minor >= 43) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(print_message, nullptr);
  }
#endif
}

}  // namespace dmoscope::render
