#pragma once
// Sets of all kernels of the search. The same code is compiled for several kinds of processor, and all give the same bits; which runs is
// decided at run time.

#include <tuple>

#include "core/numeric/simd.h"
#include "core/search/parameters.h"
#include "core/smooth/kernels/composite_kernel.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/kernels/targets/target_mean_kernel.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope {

/// Kernels of one vertex whose stars are of one kind of frame: Plane, Space or Curved. Null where there is none.
template <class Frame>
struct FrameKernels {
  CompositeKernel<Frame> (*composite)(Metric first);  // for a metric that is defined for the frame
  CompositeListKernel<Frame> (*composite_list)(Metric first);
  TargetMeanKernel<Frame> (*target_mean)(bool crossed);  // see TargetForm, solid_target.h
};

struct KernelSet {
  LaneKernel (*lanes)(Metric metric);
  LaneKernel (*target_lanes)(bool crossed);     // for the mean ratio against targets: see StarTargets
  VolumeKernel (*volume)(Metric metric);        // for a metric that is defined for volumes
  VolumeKernel (*target_volume)(bool crossed);  // for the mean ratio of tetrahedra against targets; it has no means
  std::tuple<FrameKernels<Plane>, FrameKernels<Space>, FrameKernels<Curved>> frames;

  template <class Frame>
  [[nodiscard]] const FrameKernels<Frame>& in() const noexcept {
    return std::get<FrameKernels<Frame>>(frames);
  }
};

/// Kernels for a kind of processor. `level` must be one of supported_simd_levels().
[[nodiscard]] const KernelSet& kernels(SimdLevel level);
/// Kernels that the parameters ask for.
[[nodiscard]] inline const KernelSet& kernels(const SearchParameters& parameters) {
  return kernels(parameters.simd.value_or(best_simd_level()));
}

}  // namespace dmoscope
