#include "core/smooth/kernels/lane_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
LaneKernel lane_kernel_baseline(Metric metric);
LaneKernel lane_kernel_avx2(Metric metric);
LaneKernel lane_kernel_avx512(Metric metric);

LaneKernel lane_kernel(SimdLevel level, Metric metric) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return lane_kernel_avx512(metric);
  if (level == SimdLevel::Avx2) return lane_kernel_avx2(metric);
#endif
  return lane_kernel_baseline(metric);
}

}  // namespace dmoscope
