#pragma once
// All kernels with the widest packs of the translation unit. Only the kernel_set_*.cpp, each compiled for one kind of processor, include
// it; see lane_kernel_impl.h for what that asks of the code.

#include "core/smooth/kernels/composite_kernel_impl.h"
#include "core/smooth/kernels/lane_kernel_impl.h"
#include "core/smooth/kernels/targets/target_lane_kernel_impl.h"
#include "core/smooth/kernels/targets/target_mean_kernel_impl.h"
#include "core/smooth/kernels/targets/target_volume_kernel_impl.h"
#include "core/smooth/kernels/volume_kernel_impl.h"
// Headers that must come after the packs:
#include "core/smooth/kernels/compiled/kernel_set.h"

namespace dmoscope {

template <class F, class D>
inline constexpr KernelSet kKernelsFor{
    &lanes::kernel_for<F, D>,
    &lanes::target_kernel_for<F, D>,
    &volumes::kernel_for<F, D>,
    &volumes::target_kernel_for<F, D>,
    {{&composite::kernel_for<Plane, D>, &composite::list_kernel_for<Plane, D>, &target_mean::kernel_for<Plane, D>},
     {&composite::kernel_for<Space, D>, &composite::list_kernel_for<Space, D>, &target_mean::kernel_for<Space, D>},
     {nullptr, &composite::list_kernel_for<Curved, D>, nullptr}}};

}  // namespace dmoscope
