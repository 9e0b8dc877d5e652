#include "gpu/cuda_launch.cuh"
#include "gpu/defined/target_bodies.h"

namespace dmoscope::gpu {

namespace {

template <bool Crossed>
Launcher launcher_of(Work work) {
  if (work == Work::VisitTargets) return launch<bodies::VisitTargets<Crossed>, Solo>;
  if (work == Work::VisitTargetsInTeam) return launch<bodies::VisitTargets<Crossed>, CudaTeam>;
  return launch<bodies::SearchTargets<Crossed>, StagingCudaTeam<kBlock, bodies::kTargetStageBytes>>;
}

}  // namespace

Launcher target_launcher(Work work, bool crossed) { return crossed ? launcher_of<true>(work) : launcher_of<false>(work); }

}  // namespace dmoscope::gpu
