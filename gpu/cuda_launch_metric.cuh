#pragma once
// The kernels that depend on a metric.

#include "gpu/composite_bodies.h"
#include "gpu/cuda_launch.cuh"
#include "gpu/volume_bodies.h"

namespace dmoscope::gpu {

template <Metric M>
Launcher planar_launcher(Work work) {
  switch (work) {
    case Work::VisitSmallFans:
      if constexpr (kIsRatio<M>) return launch<bodies::Visit<M, Stars::SmallFans>, Solo>;
      return nullptr;
    case Work::VisitLargeFans:
      if constexpr (kIsRatio<M>) return launch<bodies::Visit<M, Stars::LargeFans>, Solo>;
      return nullptr;
    case Work::VisitOthers:
      return launch<bodies::Visit<M, Stars::Others>, Solo>;
    case Work::VisitInTeam:
      return launch<bodies::Visit<M, Stars::All, true>, CudaTeam>;
    case Work::VisitComposite:
      return launch<bodies::VisitComposite<M, Plane>, CudaTeam>;
    case Work::Settle:
      return launch<bodies::Settle<M>, CudaTeam>;
    case Work::Judge:
      return launch<bodies::Judge<M, Plane>, Solo>;
    default:
      return nullptr;
  }
}

template <Metric M>
Launcher volume_launcher(Work work) {
  if (work == Work::VisitVolumeComposite) return launch<bodies::VisitComposite<M, Space>, CudaTeam>;
  if (work == Work::VisitVolume) return launch<bodies::VisitVolume<M>, StagingCudaTeam<kBlock, kStageBytes>>;
  return launch<bodies::Judge<M, Space>, Solo>;
}

template <std::size_t Part, std::size_t I>
Launcher part_launcher(Metric metric, Work work) {
  if constexpr (I >= kMetricCount) {
    return nullptr;
  } else {
    constexpr Metric kThis = static_cast<Metric>(I);
    if (metric != kThis) return part_launcher<Part, I + kMetricParts>(metric, work);
    if constexpr (formulas::OfVolumeElements::kHas<kThis>)
      if (is_of_solids(work)) return volume_launcher<kThis>(work);
    if constexpr (formulas::OfPlanarElements::kHas<kThis>)
      if (!is_of_solids(work)) return planar_launcher<kThis>(work);
    return nullptr;
  }
}

}  // namespace dmoscope::gpu
