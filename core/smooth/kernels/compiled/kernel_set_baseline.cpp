#include "core/smooth/kernels/compiled/kernel_set_impl.h"

namespace dmoscope {

const KernelSet& kernel_set_baseline();
const KernelSet& kernel_set_baseline() { return kKernelsFor<Pack<float>, Pack<double>>; }

}  // namespace dmoscope
