#pragma once
// The kernels for volumes.

#include "gpu/cuda_launch.cuh"
#include "gpu/volume_bodies.h"

namespace dmoscope::gpu {

template <Metric M>
Launcher volume_launcher(Work work) {
  if (work == Work::VisitVolumeComposite) return volume_composite_launcher<M>();
  if (work == Work::VisitVolume) return launch<bodies::VisitVolume<M>, StagingCudaTeam<kBlock, kStageBytes>>;
  return launch<bodies::JudgeVolume<M>, Solo>;
}

}  // namespace dmoscope::gpu
