#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
VolumeKernel volume_kernel_baseline(Metric metric);
VolumeKernel volume_kernel_avx2(Metric metric);
VolumeKernel volume_kernel_avx512(Metric metric);
VolumeKernel target_volume_kernel_baseline(bool crossed);
VolumeKernel target_volume_kernel_avx2(bool crossed);
VolumeKernel target_volume_kernel_avx512(bool crossed);

VolumeKernel volume_kernel(SimdLevel level, Metric metric) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return volume_kernel_avx512(metric);
  if (level == SimdLevel::Avx2) return volume_kernel_avx2(metric);
#endif
  return volume_kernel_baseline(metric);
}

VolumeKernel target_volume_kernel(SimdLevel level, bool crossed) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return target_volume_kernel_avx512(crossed);
  if (level == SimdLevel::Avx2) return target_volume_kernel_avx2(crossed);
#endif
  return target_volume_kernel_baseline(crossed);
}

}  // namespace dmoscope
