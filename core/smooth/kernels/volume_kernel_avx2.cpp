#include "core/smooth/kernels/volume_kernel_impl.h"

namespace dmoscope {

VolumeKernel volume_kernel_avx2(Metric metric) { return volumes::kernel_for<Pack<float>, Pack<double>>(metric); }

}  // namespace dmoscope
