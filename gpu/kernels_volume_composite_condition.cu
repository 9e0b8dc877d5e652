#include "gpu/cuda_launch_composite.cuh"

namespace dmoscope::gpu {
template Launcher volume_composite_launcher<Metric::Condition>();
}
