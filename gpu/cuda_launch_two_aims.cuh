#pragma once
// The kernels for two aims.

#include "gpu/cuda_launch.cuh"
#include "gpu/two_aims_bodies.h"

namespace dmoscope::gpu {

template <Metric M>
Launcher two_aims_launcher() {
  return launch<bodies::VisitTwoAims<M, Plane>, CudaTeam>;
}
template <Metric M>
Launcher volume_two_aims_launcher() {
  return launch<bodies::VisitTwoAims<M, Space>, CudaTeam>;
}

}  // namespace dmoscope::gpu
