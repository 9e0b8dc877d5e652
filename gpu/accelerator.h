#pragma once
// DMO on a CUDA device, in the form in which the program hands it to a session.

#include "core/smooth/execution/accelerator.h"

namespace dmoscope::gpu {

/// Returns DMO on the best CUDA device of this machine, or the reason why none can be used. Never throws.
[[nodiscard]] Acceleration make_accelerator();

}  // namespace dmoscope::gpu
