#pragma once
// Measurements without a window: the speed of stepping and drawing a run, and of seeks through the engine, as by scrubbing the timeline.

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/engine/engine.h"
#include "core/session/session.h"
#include "core/view/drawing_path.h"

namespace dmoscope::app {

struct DrawSubject {
  Session& session;  // must have a mesh; its active run is stepped
  Acceleration acceleration;
  std::uint64_t frames = 0;
  int width = 1280, height = 800;  // pixels
};

/// Results. Seconds are sums over all frames.
struct DrawFigure {
  Backend backend = Backend::Cpu;
  std::string renderer;
  DrawingPath path;
  std::uint64_t frames = 0;
  double seconds = 0.0;          // by the clock, from the first step to the end of the last picture
  double step_seconds = 0.0;     // iterations
  double publish_seconds = 0.0;  // making frames: snapshots and statistics
  double draw_seconds = 0.0;     // uploading to OpenGL and drawing, until OpenGL is done
  /// Bytes of positions and qualities that were copied from the device to the host; 0 on the CPU, where they are on the host anyway.
  std::uint64_t bytes_to_host = 0;
  [[nodiscard]] double frames_per_second() const noexcept { return static_cast<double>(frames) / seconds; }
};

/// Repeats an iteration, a frame and a picture at full detail. Throws Error (no OpenGL) and Cancelled.
[[nodiscard]] DrawFigure measure_drawing(const DrawSubject& subject, Progress& progress);

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
