#pragma once
// How fast a run is stepped and drawn, without a window.

#include <cstdint>
#include <string>

#include "core/base/progress.h"
#include "core/session/session.h"
#include "core/view/drawing_path.h"

namespace dmoscope::app {

struct DrawSubject {
  Session& session;  // with a mesh; its active run is stepped
  Acceleration acceleration;
  std::uint64_t frames = 0;
  int width = 1280, height = 800;  // pixels
};

/// Seconds are sums over all frames.
struct DrawFigure {
  Backend backend = Backend::Cpu;
  std::string renderer;
  DrawingPath path;
  std::uint64_t frames = 0;
  double seconds = 0.0;          // by the clock, from the first step to the last picture being there
  double step_seconds = 0.0;     // an iteration
  double publish_seconds = 0.0;  // making the frame: snapshot and statistics
  double draw_seconds = 0.0;     // bringing it to OpenGL and drawing it, until OpenGL is done
  /// Bytes of positions and qualities that came from the device to the host meanwhile; 0 on the CPU, where they are on the host anyway.
  std::uint64_t bytes_to_host = 0;
  [[nodiscard]] double frames_per_second() const noexcept { return static_cast<double>(frames) / seconds; }
};

/// An iteration, a frame, a picture at full detail; then the next. Throws Error (no OpenGL) and Cancelled.
[[nodiscard]] DrawFigure measure_drawing(const DrawSubject& subject, Progress& progress);

}  // namespace dmoscope::app
