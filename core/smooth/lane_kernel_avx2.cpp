#include "core/smooth/lane_kernel_of.h"

namespace dmoscope {

LaneKernel lane_kernel_avx2(Metric metric) { return lanes::kernel_for<Pack<float>, Pack<double>>(metric); }

}  // namespace dmoscope
