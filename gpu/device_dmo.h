#pragma once
// DMO on a device: the smoother that a run steps.

#include <memory>

#include "core/smooth/smoother.h"
#include "gpu/queue.h"

namespace dmoscope::gpu {

/// Makes the smoother of a run on a device. `task`: one that has passed make_smoother's checks; a planar mesh's search with one aim is in
/// float, a volume's in either precision, that of two aims in double, and their sizes are not those of a nodal field. There is no picture()
/// of a volume, since the host finds out which of its faces are seen. Throws DeviceError, for instance if the mesh does not fit into the
/// device's memory.
[[nodiscard]] std::unique_ptr<Smoother> make_device_dmo(std::shared_ptr<Queue> queue, const SmoothingTask& task);

}  // namespace dmoscope::gpu
