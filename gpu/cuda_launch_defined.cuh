#pragma once
// Kernels by metrics that are defined by formulas or targets.

#include "gpu/cuda_launch.cuh"
#include "gpu/defined/bodies.h"
#include "gpu/defined/warp.h"

namespace dmoscope::gpu {

template <class Frame>
Launcher defined_launcher(Work work, bool in_double) {
  switch (work) {
    case Work::PrepareDefined:
      return launch<bodies::PrepareDefined<Frame>, Solo>;
    case Work::SearchDefined:
      return in_double ? launch<bodies::SearchDefined<Frame, double>, Warp> : launch<bodies::SearchDefined<Frame, float>, Warp>;
    case Work::UntangleDefined:
      return launch<bodies::UntangleDefined<Frame>, CudaTeam>;
    case Work::SettleDefined:
      return launch<bodies::SettleDefined<Frame>, Solo>;
    case Work::JudgeDefined:
      return launch<bodies::JudgeDefined<Frame>, Solo>;
    default:
      return nullptr;
  }
}

}  // namespace dmoscope::gpu
