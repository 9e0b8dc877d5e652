#include "core/smooth/kernels/composite_kernel.h"

namespace dmoscope {

namespace composite {
// Defined in the files of these names.
CompositeKernel<Plane> planar_kernel_baseline(Metric first);
CompositeKernel<Plane> planar_kernel_avx2(Metric first);
CompositeKernel<Plane> planar_kernel_avx512(Metric first);
CompositeKernel<Space> volume_kernel_baseline(Metric first);
CompositeKernel<Space> volume_kernel_avx2(Metric first);
CompositeKernel<Space> volume_kernel_avx512(Metric first);
CompositeListKernel<Plane> planar_list_kernel_baseline(Metric first);
CompositeListKernel<Plane> planar_list_kernel_avx2(Metric first);
CompositeListKernel<Plane> planar_list_kernel_avx512(Metric first);
CompositeListKernel<Space> volume_list_kernel_baseline(Metric first);
CompositeListKernel<Space> volume_list_kernel_avx2(Metric first);
CompositeListKernel<Space> volume_list_kernel_avx512(Metric first);
CompositeListKernel<Curved> surface_list_kernel_baseline(Metric first);
CompositeListKernel<Curved> surface_list_kernel_avx2(Metric first);
CompositeListKernel<Curved> surface_list_kernel_avx512(Metric first);
}  // namespace composite

template <>
CompositeKernel<Plane> composite_kernel<Plane>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return composite::planar_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return composite::planar_kernel_avx2(first);
#endif
  return composite::planar_kernel_baseline(first);
}
template <>
CompositeKernel<Space> composite_kernel<Space>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return composite::volume_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return composite::volume_kernel_avx2(first);
#endif
  return composite::volume_kernel_baseline(first);
}
template <>
CompositeListKernel<Plane> composite_list_kernel<Plane>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return composite::planar_list_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return composite::planar_list_kernel_avx2(first);
#endif
  return composite::planar_list_kernel_baseline(first);
}
template <>
CompositeListKernel<Space> composite_list_kernel<Space>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return composite::volume_list_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return composite::volume_list_kernel_avx2(first);
#endif
  return composite::volume_list_kernel_baseline(first);
}
template <>
CompositeListKernel<Curved> composite_list_kernel<Curved>([[maybe_unused]] SimdLevel level, Metric first) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return composite::surface_list_kernel_avx512(first);
  if (level == SimdLevel::Avx2) return composite::surface_list_kernel_avx2(first);
#endif
  return composite::surface_list_kernel_baseline(first);
}

}  // namespace dmoscope
