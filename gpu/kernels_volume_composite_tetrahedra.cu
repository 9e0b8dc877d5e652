#include "gpu/cuda_launch_composite.cuh"

namespace dmoscope::gpu {
template Launcher volume_composite_launcher<Metric::RadiusRatio>();
template Launcher volume_composite_launcher<Metric::MinAngle>();
template Launcher volume_composite_launcher<Metric::AspectRatio>();
}  // namespace dmoscope::gpu
