#pragma once
// The --backend option: devices that runs may use besides the CPU.

#include "core/smooth/execution/executor.h"
#include "gpu/accelerator.h"

namespace dmoscope::app {

/// Returns the accelerator of this machine, which is looked for only if `wanted` may need one. Throws UsageError with the reason if
/// `wanted` names one that cannot be used.
[[nodiscard]] inline Acceleration acceleration_for(Backend wanted) {
  if (wanted == Backend::Cpu) return {nullptr, "the program was started with --backend cpu"};
  Acceleration acceleration = gpu::make_accelerator();
  require_backend(wanted, acceleration);
  return acceleration;
}

}  // namespace dmoscope::app
