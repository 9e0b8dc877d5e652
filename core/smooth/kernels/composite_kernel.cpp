#include "core/smooth/kernels/composite_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
CompositeKernel<Plane> planar_composite_kernel_baseline(Metric first);
CompositeKernel<Plane> planar_composite_kernel_avx2(Metric first);
CompositeKernel<Plane> planar_composite_kernel_avx512(Metric first);
CompositeKernel<Space> volume_composite_kernel_baseline(Metric first);
CompositeKernel<Space> volume_composite_kernel_avx2(Metric first);
CompositeKernel<Space> volume_composite_kernel_avx512(Metric first);

template <>
CompositeKernel<Plane> composite_kernel<Plane>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return planar_composite_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return planar_composite_kernel_avx2(first);
#endif
  return planar_composite_kernel_baseline(first);
}
template <>
CompositeKernel<Space> composite_kernel<Space>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return volume_composite_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return volume_composite_kernel_avx2(first);
#endif
  return volume_composite_kernel_baseline(first);
}

}  // namespace dmoscope
