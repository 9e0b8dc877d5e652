#pragma once
// What a big mesh costs in the window: until it is seen, until the window answers, and memory.

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct WindowSubject {
  std::string line;  // that opens the mesh
  Acceleration acceleration;
  unsigned threads = 0;
  std::uint64_t iterations = 60;
  int width = 1280, height = 800;  // pixels
};

struct WindowCost {
  double seconds = 0.0;    // by the clock
  double processor = 0.0;  // seconds of all threads
};

struct WindowFigure {
  std::string renderer;
  Index vertices = 0, elements = 0;
  WindowCost first;  // from the program's start to the first picture of the mesh
  WindowCost full;   // to the first with all elements
  WindowCost rest;   // until nothing is to be done any more
  /// From the input to the end of the frame that shows what it did; the mean of some.
  WindowCost zoom, pan, pick, fit;
  WindowCost zoom_in_midst;                     // while the full picture is being drawn
  double longest = 0.0;                         // answer of all these by the clock, seconds
  WindowCost iteration;                         // one, until it is seen
  WindowCost metric;                            // from `show METRIC` in the midst of a run to the end of the frame that shows it, the mean
  double metric_longest = 0.0;                  // of these, seconds
  int metric_frames = 0;                        // most frames that were drawn for one, the one that shows it included
  WindowCost run;                               // all of them, with the window drawn meanwhile
  std::size_t memory_open = 0, memory_run = 0;  // the most so far, bytes: at rest after opening, and after the iterations
};

/// Opens a mesh as the window on a screen does, zooms, moves, picks, fits, runs. Throws Error (no OpenGL, no such mesh) and Cancelled.
[[nodiscard]] WindowFigure measure_window(const WindowSubject& subject, Progress& progress);

}  // namespace dmoscope::app
