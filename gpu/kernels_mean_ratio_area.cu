#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {
template Launcher metric_launcher<Metric::MeanRatioArea>(Work work);
}
