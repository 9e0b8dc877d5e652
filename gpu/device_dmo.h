#pragma once
// DMO on a device: the smoother that a run steps.

#include <memory>

#include "core/smooth/smoother.h"
#include "gpu/queue.h"

namespace dmoscope::gpu {

/// `parameters`: of a planar mesh's search in float, of a volume's in either precision; `immovable`: see compute_statistics. There is no
/// picture() of a volume: which of its faces are seen, the host finds out. The arguments must have passed make_smoother's checks. Throws
/// DeviceError, for instance where the mesh does not fit into the device's memory.
[[nodiscard]] std::unique_ptr<Smoother> make_device_dmo(std::shared_ptr<Queue> queue, std::shared_ptr<const InputMesh> input,
                                                        std::shared_ptr<const Colouring> colouring, Metric metric,
                                                        const SearchParameters& parameters, std::span<const Index> immovable,
                                                        ThreadPool* pool);

}  // namespace dmoscope::gpu
