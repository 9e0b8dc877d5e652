#include "core/smooth/kernels/targets/target_mean_kernel.h"

namespace dmoscope {

namespace target_mean {
// Defined in the files of these names.
TargetMeanKernel<Plane> planar_kernel_baseline(bool crossed);
TargetMeanKernel<Plane> planar_kernel_avx2(bool crossed);
TargetMeanKernel<Plane> planar_kernel_avx512(bool crossed);
TargetMeanKernel<Space> volume_kernel_baseline(bool crossed);
TargetMeanKernel<Space> volume_kernel_avx2(bool crossed);
TargetMeanKernel<Space> volume_kernel_avx512(bool crossed);
}  // namespace target_mean

template <>
TargetMeanKernel<Plane> target_mean_kernel<Plane>([[maybe_unused]] SimdLevel level, bool crossed) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return target_mean::planar_kernel_avx512(crossed);
  if (level == SimdLevel::Avx2) return target_mean::planar_kernel_avx2(crossed);
#endif
  return target_mean::planar_kernel_baseline(crossed);
}
template <>
TargetMeanKernel<Space> target_mean_kernel<Space>([[maybe_unused]] SimdLevel level, bool crossed) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return target_mean::volume_kernel_avx512(crossed);
  if (level == SimdLevel::Avx2) return target_mean::volume_kernel_avx2(crossed);
#endif
  return target_mean::volume_kernel_baseline(crossed);
}

}  // namespace dmoscope
