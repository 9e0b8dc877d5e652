#include "core/smooth/kernels/lane_kernel_impl.h"

namespace dmoscope {

LaneKernel lane_kernel_avx512(Metric metric) { return lanes::kernel_for<Pack<float>, Pack<double>>(metric); }

}  // namespace dmoscope
