#pragma once
// The window: GLFW, its event loop, and the interface drawn on demand.

#include <filesystem>
#include <vector>

#include "core/engine/engine.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct WindowOptions {
  std::vector<std::filesystem::path> files;  // opened at the start, beside each other
  unsigned threads = 0;                      // threads of smoothing; 0: one per hardware thread
  Backend backend = Backend::Auto;           // backend of the first run
  double scale = 0.0;                        // scale of the interface; 0: as saved, else the monitor's
  Engine::ReportWriter report{};             // for the command save-report; empty: there is none
  bool scripted = false;                     // settings are neither read nor written, and the script moves the mouse
};

/// Opens the window and returns when it is closed (0). Throws Error with a clear sentence (which names the subcommands that need no screen)
/// if there is no display or OpenGL is too old.
int run_window(const WindowOptions& options);

}  // namespace dmoscope::app
