#include "gpu/cuda_launch_volume.cuh"

namespace dmoscope::gpu {
template Launcher volume_launcher<Metric::ScaledJacobian>(Work work);
}
