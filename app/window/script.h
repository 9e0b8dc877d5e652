#pragma once
// Scripts: command lines that drive the session and the window, with or without a screen.

#include <cstdint>
#include <string>
#include <vector>

#include "core/engine/engine.h"
#include "core/smooth/execution/accelerator.h"

namespace dmoscope::app {

struct ScriptOptions {
  std::string name = "script";     // for messages, usually the file's name
  std::vector<std::string> lines;  // one command each; empty lines and comments are skipped
  bool headless = true;            // the window is drawn off screen; else a real window shows what happens
  int width = 1280, height = 800;  // pixels
  double scale = 1.0;              // of the interface
  unsigned threads = 0;
  Backend backend = Backend::Auto;
  Engine::ReportWriter report{};  // of the command save-report; empty: there is none
  std::uint64_t most_memory = 0;  // bytes that a file may unpack to; 0: see UnpackBudget
};

/// Runs the lines one after another, each until it is done. What the session says goes to standard output, what goes wrong to
/// standard error as "dmoscope: name:LINE: what". Stops at the first failing line and returns its exit code; 0 when all went well.
/// A script without view subcommands needs no OpenGL.
int run_script(const ScriptOptions& options);

}  // namespace dmoscope::app
