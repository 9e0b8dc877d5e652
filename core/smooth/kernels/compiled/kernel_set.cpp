#include "core/smooth/kernels/compiled/kernel_set.h"

namespace dmoscope {

// Sets of kernels, defined in the files of these names.
const KernelSet& kernel_set_baseline();
const KernelSet& kernel_set_avx2();
const KernelSet& kernel_set_avx512();

const KernelSet& kernels([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return kernel_set_avx512();
  if (level == SimdLevel::Avx2) return kernel_set_avx2();
#endif
  return kernel_set_baseline();
}

}  // namespace dmoscope
