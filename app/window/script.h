#pragma once
// Scripts: lines of commands for the session and the window, with or without a screen.

#include <cstdint>
#include <string>
#include <vector>

#include "core/engine/engine.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct ScriptOptions {
  std::string name = "script";     // for messages, usually the file's name
  std::vector<std::string> lines;  // one command each; empty lines and comments are skipped
  bool headless = true;            // whether the window is drawn off screen; else it is shown
  int width = 1280, height = 800;  // pixels
  double scale = 1.0;              // scale of the interface
  unsigned threads = 0;
  Backend backend = Backend::Auto;
  Engine::ReportWriter report{};  // for the command save-report; empty: there is none
  std::uint64_t most_memory = 0;  // greatest unpacked size of a file, bytes; 0: see UnpackBudget
};

/// Runs the lines one after another, each until it is done. Messages of the session go to standard output, errors to standard error as
/// "dmoscope: name:LINE: what". Stops at the first failing line and returns its exit code; 0 if none failed. A script without view
/// subcommands needs no OpenGL.
int run_script(const ScriptOptions& options);

}  // namespace dmoscope::app
