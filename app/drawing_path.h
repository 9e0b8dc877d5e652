#pragma once
// How what a run computes gets to the screen on this machine.

#include <string>

#include <fmt/format.h>

#include "core/smooth/accelerator.h"

namespace dmoscope::app {

struct DrawingPath {
  std::string name;    // "cuda with interop", "cuda with host copy" or "cpu"
  std::string reason;  // why nothing faster; empty for the fastest
};

/// `no_interop`: why the accelerator cannot write OpenGL's buffers; empty where it can.
[[nodiscard]] inline DrawingPath drawing_path(const Acceleration& acceleration, const std::string& no_interop) {
  if (!acceleration.accelerator) return {"cpu", fmt::format("no cuda: {}", acceleration.reason)};
  const std::string name = acceleration.accelerator->name();
  if (!no_interop.empty()) return {fmt::format("{} with host copy", name), fmt::format("no interop: {}", no_interop)};
  return {fmt::format("{} with interop", name), {}};
}

}  // namespace dmoscope::app
