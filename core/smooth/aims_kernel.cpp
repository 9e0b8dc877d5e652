#include "core/smooth/aims_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
AimsKernel<Plane> planar_aims_kernel_baseline(Metric first);
AimsKernel<Plane> planar_aims_kernel_avx2(Metric first);
AimsKernel<Plane> planar_aims_kernel_avx512(Metric first);
AimsKernel<Space> solid_aims_kernel_baseline(Metric first);
AimsKernel<Space> solid_aims_kernel_avx2(Metric first);
AimsKernel<Space> solid_aims_kernel_avx512(Metric first);

template <>
AimsKernel<Plane> aims_kernel<Plane>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return planar_aims_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return planar_aims_kernel_avx2(first);
#endif
  return planar_aims_kernel_baseline(first);
}
template <>
AimsKernel<Space> aims_kernel<Space>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return solid_aims_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return solid_aims_kernel_avx2(first);
#endif
  return solid_aims_kernel_baseline(first);
}

}  // namespace dmoscope
