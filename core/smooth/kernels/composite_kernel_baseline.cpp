#include "core/smooth/kernels/composite_kernel_impl.h"

namespace dmoscope {

CompositeKernel<Plane> planar_composite_kernel_baseline(Metric first) { return composite::kernel_for<Plane, Pack<double>>(first); }
CompositeKernel<Space> volume_composite_kernel_baseline(Metric first) { return composite::kernel_for<Space, Pack<double>>(first); }

}  // namespace dmoscope
