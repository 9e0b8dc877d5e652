#include "core/smooth/solid_kernel.h"

namespace dmoscope {

// Defined in the files of these names.
SolidKernel solid_kernel_baseline(Metric metric);
SolidKernel solid_kernel_avx2(Metric metric);
SolidKernel solid_kernel_avx512(Metric metric);

SolidKernel solid_kernel(SimdLevel level, Metric metric) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return solid_kernel_avx512(metric);
  if (level == SimdLevel::Avx2) return solid_kernel_avx2(metric);
#endif
  return solid_kernel_baseline(metric);
}

}  // namespace dmoscope
