#include "gpu/cuda_launch_metric.cuh"

namespace dmoscope::gpu {
template Launcher part_launcher<4>(Metric metric, Work work);
}
