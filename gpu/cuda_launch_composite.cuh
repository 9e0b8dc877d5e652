#pragma once
// The kernels for two aims.

#include "gpu/composite_bodies.h"
#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {

template <Metric M>
Launcher composite_launcher() {
  return launch<bodies::VisitComposite<M, Plane>, CudaTeam>;
}
template <Metric M>
Launcher volume_composite_launcher() {
  return launch<bodies::VisitComposite<M, Space>, CudaTeam>;
}

}  // namespace dmoscope::gpu
