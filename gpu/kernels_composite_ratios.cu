#include "gpu/cuda_launch_composite.cuh"

namespace dmoscope::gpu {
template Launcher composite_launcher<Metric::MeanRatio>();
template Launcher composite_launcher<Metric::MeanRatioArea>();
template Launcher composite_launcher<Metric::RadiusRatio>();
template Launcher composite_launcher<Metric::AspectRatio>();
}  // namespace dmoscope::gpu
