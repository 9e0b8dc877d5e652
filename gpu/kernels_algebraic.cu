#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {
template Launcher metric_launcher<Metric::RadiusRatio>(Work work);
template Launcher metric_launcher<Metric::ScaledJacobian>(Work work);
template Launcher metric_launcher<Metric::AspectRatio>(Work work);
}  // namespace dmoscope::gpu
