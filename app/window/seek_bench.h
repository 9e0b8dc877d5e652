#pragma once
// Measurement of seeks through the engine, the speed of scrubbing the timeline, without a window.

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/engine/engine.h"

namespace dmoscope::app {

/// Seconds of each seek or frame.
struct SeekFigure {
  std::vector<double> seeks;        // from the command to the view that shows it
  std::vector<double> drawn;        // times until the picture is drawn, too
  std::vector<double> full_frames;  // drawing of any whole frame of the mesh
  std::string renderer;
};

/// Measures `seeks` seeks to random iterations without, and as many with drawing a picture of 1280 x 800 pixels. `engine`: has an open mesh
/// and a run with so many `iterations`. Throws Error (no OpenGL) and Cancelled.
[[nodiscard]] SeekFigure measure_seeks(Engine& engine, const Acceleration& acceleration, std::uint64_t iterations, std::uint64_t seeks,
                                       Progress& progress);

}  // namespace dmoscope::app
