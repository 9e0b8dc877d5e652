#include "gpu/cuda_launch_two_aims.cuh"

namespace dmoscope::gpu {
template Launcher volume_two_aims_launcher<Metric::ScaledJacobian>();
}
