#pragma once
// A drawing as pixels.

#include "app/drawing.h"
#include "render/image.h"

namespace dmoscope::app {

/// The drawing on white, two pixels a unit. Needs no OpenGL. Throws Error when the system's font is missing.
[[nodiscard]] render::Image picture_of(const Drawing& drawing);

}  // namespace dmoscope::app
