#include "core/smooth/aims_kernel_of.h"

namespace dmoscope {

AimsKernel<Plane> planar_aims_kernel_baseline(Metric first) { return aims::kernel_for<Plane, Pack<double>>(first); }
AimsKernel<Space> solid_aims_kernel_baseline(Metric first) { return aims::kernel_for<Space, Pack<double>>(first); }

}  // namespace dmoscope
