#pragma once
// How fast the timeline can be scrubbed: seeks through the engine, without a window.

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/engine/engine.h"

namespace dmoscope::app {

/// Seconds of each.
struct SeekFigure {
  std::vector<double> seeks;        // from the command to the view that shows it
  std::vector<double> drawn;        // until its picture is drawn, too
  std::vector<double> full_frames;  // drawing any whole frame of the mesh
  std::string renderer;
};

/// `engine` has an open mesh and a run with so many `iterations`. `seeks`: to random ones of them, so many without and so many with drawing
/// a picture of 1280 x 800 pixels. Throws Error (no OpenGL) and Cancelled.
[[nodiscard]] SeekFigure measure_seeks(Engine& engine, const Acceleration& acceleration, std::uint64_t iterations, std::uint64_t seeks,
                                       Progress& progress);

}  // namespace dmoscope::app
