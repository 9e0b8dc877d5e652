#pragma once
// Costs of a big mesh in the window: time until it is shown, time of answers, and memory.

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct WindowSubject {
  std::string line;  // command that opens the mesh
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
  WindowCost full;   // from the program's start to the first picture with all elements
  WindowCost rest;   // from the program's start until all work is done
  /// From the input to the end of the frame that shows its effect; means of some.
  WindowCost zoom, pan, pick, fit;
  WindowCost zoom_in_midst;                     // while the full picture is being drawn
  double longest = 0.0;                         // longest of these answers by the clock, seconds
  WindowCost iteration;                         // one iteration, until it is shown
  WindowCost metric;                            // from `show METRIC` during a run to the end of the frame that shows it, mean
  double metric_longest = 0.0;                  // longest of these, seconds
  int metric_frames = 0;                        // most frames drawn for one, including the one that shows it
  WindowCost run;                               // all iterations, with the window drawn meanwhile
  std::size_t memory_open = 0, memory_run = 0;  // peaks, bytes: at rest after opening, and after the iterations
};

/// Opens a mesh as the window on a screen does, zooms, moves, picks, fits, runs. Throws Error (no OpenGL, no such mesh) and Cancelled.
[[nodiscard]] WindowFigure measure_window(const WindowSubject& subject, Progress& progress);

}  // namespace dmoscope::app
