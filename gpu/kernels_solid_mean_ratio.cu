#include "gpu/cuda_launch_solid.cuh"

namespace dmoscope::gpu {
template Launcher solid_launcher<Metric::MeanRatio>(Work work);
}
