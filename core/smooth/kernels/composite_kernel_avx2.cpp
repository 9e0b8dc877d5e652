#include "core/smooth/kernels/composite_kernel_impl.h"

namespace dmoscope::composite {

CompositeKernel<Plane> planar_kernel_avx2(Metric first) { return kernel_for<Plane, Pack<double>>(first); }
CompositeKernel<Space> volume_kernel_avx2(Metric first) { return kernel_for<Space, Pack<double>>(first); }
CompositeListKernel<Plane> planar_list_kernel_avx2(Metric first) { return list_kernel_for<Plane, Pack<double>>(first); }
CompositeListKernel<Space> volume_list_kernel_avx2(Metric first) { return list_kernel_for<Space, Pack<double>>(first); }
CompositeListKernel<Curved> surface_list_kernel_avx2(Metric first) { return list_kernel_for<Curved, Pack<double>>(first); }

}  // namespace dmoscope::composite
