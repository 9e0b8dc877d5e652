#pragma once
// The window: GLFW, its event loop, and the interface drawn on demand.

#include <filesystem>
#include <vector>

#include "core/engine/engine.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct WindowOptions {
  std::vector<std::filesystem::path> files;  // opened at the start, beside each other
  unsigned threads = 0;                      // of the smoothing; 0: one a hardware thread
  Backend backend = Backend::Auto;           // of the first run
  double scale = 0.0;                        // of the interface; 0: as saved, else as the monitor says
  Engine::ReportWriter report{};             // of the command save-report; empty: there is none
  bool scripted = false;                     // settings are neither read nor written, and the mouse is the script's
};

/// Opens the window and returns when it is closed (0). Throws Error with a clear sentence (and names the subcommands that need no
/// screen) when there is no display or OpenGL is too old.
int run_window(const WindowOptions& options);

}  // namespace dmoscope::app
