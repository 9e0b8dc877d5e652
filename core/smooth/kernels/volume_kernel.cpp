#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
VolumeKernel volume_kernel_baseline(Metric metric);
VolumeKernel volume_kernel_avx2(Metric metric);
VolumeKernel volume_kernel_avx512(Metric metric);

VolumeKernel volume_kernel(SimdLevel level, Metric metric) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return volume_kernel_avx512(metric);
  if (level == SimdLevel::Avx2) return volume_kernel_avx2(metric);
#endif
  return volume_kernel_baseline(metric);
}

}  // namespace dmoscope
