#include "core/smooth/kernels/compiled/kernel_set_impl.h"

namespace dmoscope {

const KernelSet& kernel_set_avx2();
const KernelSet& kernel_set_avx2() { return kKernelsFor<Pack<float>, Pack<double>>; }

}  // namespace dmoscope
