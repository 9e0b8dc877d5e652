#include "core/smooth/kernels/targets/target_lane_kernel_impl.h"

namespace dmoscope {

LaneKernel target_lane_kernel_baseline(bool crossed) { return lanes::target_kernel_for<Pack<float>, Pack<double>>(crossed); }

}  // namespace dmoscope
