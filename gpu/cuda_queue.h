#pragma once
// A queue of work on a CUDA device.

#include <memory>

#include "gpu/queue.h"

namespace dmoscope::gpu {

/// Makes a queue on device number `device`, which probe() found usable. Throws CudaError, and DeviceError if the program was built without
/// a toolkit.
[[nodiscard]] std::shared_ptr<Queue> make_cuda_queue(int device);

}  // namespace dmoscope::gpu
