#pragma once
// DMO on a CUDA device, as the program hands it to a session.

#include "core/smooth/execution/accelerator.h"

namespace dmoscope::gpu {

/// The best CUDA device of this machine, or why none can be used. Never throws.
[[nodiscard]] Acceleration make_accelerator();

}  // namespace dmoscope::gpu
