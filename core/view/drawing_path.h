#pragma once
// Path of computed positions to the screen.

#include <string>
#include <string_view>

#include "core/smooth/execution/accelerator.h"

namespace dmoscope {

struct DrawingPath {
  std::string name;    // name: "cuda with interop", "cuda with host copy" or "cpu"
  std::string reason;  // reason why no faster path is used; empty for the fastest
  /// Name and reason: "cuda with host copy: no interop: OpenGL is drawn by the processor".
  [[nodiscard]] std::string sentence() const { return reason.empty() ? name : name + ": " + reason; }
};

/// The drawing path of a run. `backend`, `backend_reason`: its backend, and on the CPU the reason for that (see Run). `no_interop`: reason
/// why the device cannot write OpenGL's buffers; empty if it can.
[[nodiscard]] inline DrawingPath drawing_path(Backend backend, std::string_view backend_reason, std::string_view no_interop) {
  if (backend == Backend::Cpu) return {"cpu", std::string(backend_reason)};
  if (no_interop.empty()) return {std::string(name(backend)) + " with interop", {}};
  return {std::string(name(backend)) + " with host copy", "no interop: " + std::string(no_interop)};
}

}  // namespace dmoscope
