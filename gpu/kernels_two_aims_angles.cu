#include "gpu/cuda_launch_two_aims.cuh"

namespace dmoscope::gpu {
template Launcher two_aims_launcher<Metric::MinAngle>();
template Launcher two_aims_launcher<Metric::MaxAngle>();
template Launcher two_aims_launcher<Metric::Rectangularity>();
template Launcher two_aims_launcher<Metric::ScaledJacobian>();
}  // namespace dmoscope::gpu
