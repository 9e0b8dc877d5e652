#include "core/smooth/solid_kernel_of.h"

namespace dmoscope {

SolidKernel solid_kernel_avx2(Metric metric) { return solids::kernel_for<Pack<float>>(metric); }

}  // namespace dmoscope
