#include "core/smooth/kernels/targets/target_volume_kernel_impl.h"

namespace dmoscope {

VolumeKernel target_volume_kernel_avx512(bool crossed) { return volumes::target_kernel_for<Pack<float>, Pack<double>>(crossed); }

}  // namespace dmoscope
