#include "gpu/cuda_launch_solid.cuh"

// The metrics that are of tetrahedra alone.
namespace dmoscope::gpu {
template Launcher solid_launcher<Metric::RadiusRatio>(Work work);
template Launcher solid_launcher<Metric::MinAngle>(Work work);
template Launcher solid_launcher<Metric::AspectRatio>(Work work);
}  // namespace dmoscope::gpu
