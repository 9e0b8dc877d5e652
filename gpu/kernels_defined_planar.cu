#include "gpu/cuda_launch_defined.cuh"

namespace dmoscope::gpu {
template Launcher defined_launcher<Plane>(Work work, bool in_double);
}
