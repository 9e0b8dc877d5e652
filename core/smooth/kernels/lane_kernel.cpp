#include "core/smooth/kernels/lane_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
LaneKernel lane_kernel_baseline(Metric metric);
LaneKernel lane_kernel_avx2(Metric metric);
LaneKernel lane_kernel_avx512(Metric metric);
LaneKernel target_lane_kernel_baseline(bool crossed);
LaneKernel target_lane_kernel_avx2(bool crossed);
LaneKernel target_lane_kernel_avx512(bool crossed);

LaneKernel lane_kernel(SimdLevel level, Metric metric) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return lane_kernel_avx512(metric);
  if (level == SimdLevel::Avx2) return lane_kernel_avx2(metric);
#endif
  return lane_kernel_baseline(metric);
}

LaneKernel target_lane_kernel(SimdLevel level, bool crossed) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return target_lane_kernel_avx512(crossed);
  if (level == SimdLevel::Avx2) return target_lane_kernel_avx2(crossed);
#endif
  return target_lane_kernel_baseline(crossed);
}

}  // namespace dmoscope
