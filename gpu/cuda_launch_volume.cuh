#pragma once
// The kernels for volumes.

#include "gpu/cuda_launch.cuh"
#include "gpu/volume_bodies.h"

namespace dmoscope::gpu {

/// A team has the places of its candidates in common, not its vertices, so its lanes read the same elements at once: there is no other way.
template <Metric M>
Launcher volume_launcher(Work work) {
  if (work == Work::VisitVolume) return launch<bodies::VisitVolume<M>, CudaTeam>;
  return launch<bodies::JudgeVolume<M>, Solo>;
}

}  // namespace dmoscope::gpu
