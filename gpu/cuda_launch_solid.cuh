#pragma once
// The kernels for volumes.

#include "gpu/cuda_launch.cuh"
#include "gpu/solid_bodies.h"

namespace dmoscope::gpu {

/// A team has the places of its candidates in common, not its vertices, so its lanes read the same elements at once: there is no other way.
template <Metric M>
Launcher solid_launcher(Work work) {
  if (work == Work::VisitSolid) return launch<bodies::VisitSolid<M>, CudaTeam>;
  return launch<bodies::JudgeSolid<M>, Solo>;
}

}  // namespace dmoscope::gpu
