#pragma once
// How what a run computes gets to the screen.

#include <string>
#include <string_view>

#include "core/smooth/execution/accelerator.h"

namespace dmoscope {

struct DrawingPath {
  std::string name;    // "cuda with interop", "cuda with host copy" or "cpu"
  std::string reason;  // why nothing faster; empty for the fastest
  /// "cuda with host copy: no interop: OpenGL is drawn by the processor"
  [[nodiscard]] std::string sentence() const { return reason.empty() ? name : name + ": " + reason; }
};

/// `backend`, `backend_reason`: what smooths, and on the CPU why nothing faster does (see Run). `no_interop`: why a device that smooths
/// cannot write OpenGL's buffers; empty where it can.
[[nodiscard]] inline DrawingPath drawing_path(Backend backend, std::string_view backend_reason, std::string_view no_interop) {
  if (backend == Backend::Cpu) return {"cpu", std::string(backend_reason)};
  if (no_interop.empty()) return {std::string(name(backend)) + " with interop", {}};
  return {std::string(name(backend)) + " with host copy", "no interop: " + std::string(no_interop)};
}

}  // namespace dmoscope
