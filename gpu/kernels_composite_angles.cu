#include "gpu/cuda_launch_composite.cuh"

namespace dmoscope::gpu {
template Launcher composite_launcher<Metric::MinAngle>();
template Launcher composite_launcher<Metric::MaxAngle>();
template Launcher composite_launcher<Metric::Rectangularity>();
template Launcher composite_launcher<Metric::ScaledJacobian>();
}  // namespace dmoscope::gpu
