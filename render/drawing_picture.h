#pragma once
// A drawing as pixels.

#include "core/drawing/drawing.h"
#include "render/image.h"

namespace dmoscope::render {

/// The drawing on white, `scale` pixels per unit (1 to 8). Needs no OpenGL. Throws Error when the system's font is missing.
[[nodiscard]] Image picture_of(const Drawing& drawing, int scale = 2);

}  // namespace dmoscope::render
