#include "gpu/cuda_launch_two_aims.cuh"

namespace dmoscope::gpu {
template Launcher two_aims_launcher<Metric::MeanRatio>();
template Launcher two_aims_launcher<Metric::MeanRatioArea>();
template Launcher two_aims_launcher<Metric::RadiusRatio>();
template Launcher two_aims_launcher<Metric::AspectRatio>();
}  // namespace dmoscope::gpu
