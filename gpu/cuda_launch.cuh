#pragma once
// The kernels: a body of gpu/bodies.h for each lane or team of lanes.

#include <cuda_runtime.h>

#include "gpu/bodies.h"
#include "gpu/cuda_error.h"
#include "gpu/cuda_launch.h"
#include "gpu/cuda_team.cuh"

namespace dmoscope::gpu {

inline constexpr unsigned kBlock = 128;  // threads

template <class Body, class Team>
__global__ void __launch_bounds__(kBlock) kernel(const __grid_constant__ Task task, std::size_t count) {
  const std::size_t i = (std::size_t{blockIdx.x} * kBlock + threadIdx.x) / Team::kSize;
  if (i < count) Body::run(task, i, count, Team{});
}

template <class Body, class Team>
void launch(const Task& task, std::size_t count, cudaStream_t stream) {
  const std::size_t blocks = (count * Team::kSize + kBlock - 1) / kBlock;
  void* arguments[] = {const_cast<Task*>(&task), &count};
  // Not <<<>>>, whose status would be that of whatever failed last on this thread.
  DMOSCOPE_CUDA_CHECK(cudaLaunchKernel(kernel<Body, Team>, dim3(static_cast<unsigned>(blocks)), dim3(kBlock), arguments, 0, stream));
}

template <Metric M>
Launcher metric_launcher(Work work) {
  switch (work) {
    case Work::VisitFans:
      if constexpr (kIsRatio<M>) return launch<bodies::Visit<M, Stars::Fans>, Solo>;
      return nullptr;
    case Work::VisitOthers:
      return launch<bodies::Visit<M, Stars::Others>, Solo>;
    case Work::VisitInTeam:
      return launch<bodies::Visit<M, Stars::All, true>, CudaTeam>;
    case Work::Settle:
      return launch<bodies::Settle<M>, CudaTeam>;
    case Work::Judge:
      return launch<bodies::Judge<M>, Solo>;
    default:
      return nullptr;
  }
}

}  // namespace dmoscope::gpu
