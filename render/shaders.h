#pragma once
// The shaders of resources/shaders, embedded into the program when it is built.

#include <string_view>

namespace dmoscope::render {

/// Text of a shader by its file name ("elements.vert.glsl"); empty when there is none.
[[nodiscard]] std::string_view shader_text(std::string_view name);

}  // namespace dmoscope::render
