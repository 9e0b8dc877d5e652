#include "gpu/cuda_launch_volume.cuh"

// The metrics that are of tetrahedra alone.
namespace dmoscope::gpu {
template Launcher volume_launcher<Metric::RadiusRatio>(Work work);
template Launcher volume_launcher<Metric::MinAngle>(Work work);
template Launcher volume_launcher<Metric::AspectRatio>(Work work);
}  // namespace dmoscope::gpu
