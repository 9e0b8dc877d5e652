#pragma once
// A queue of work on a CUDA device.

#include <memory>

#include "gpu/queue.h"

namespace dmoscope::gpu {

/// On device number `device`, which probe() found usable. Throws CudaError, and DeviceError where the program was built without a toolkit.
[[nodiscard]] std::shared_ptr<Queue> make_cuda_queue(int device);

}  // namespace dmoscope::gpu
