#include "core/smooth/kernels/targets/target_mean_kernel_impl.h"

namespace dmoscope::target_mean {

TargetMeanKernel<Plane> planar_kernel_baseline(bool crossed) { return kernel_for<Plane, Pack<double>>(crossed); }
TargetMeanKernel<Space> volume_kernel_baseline(bool crossed) { return kernel_for<Space, Pack<double>>(crossed); }

}  // namespace dmoscope::target_mean
