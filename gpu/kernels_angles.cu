#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {
template Launcher metric_launcher<Metric::MinAngle>(Work work);
template Launcher metric_launcher<Metric::MaxAngle>(Work work);
template Launcher metric_launcher<Metric::Rectangularity>(Work work);
}  // namespace dmoscope::gpu
