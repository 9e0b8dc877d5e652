#pragma once
// The kernels: a body of gpu/bodies.h for each lane or team of lanes.

#include <cuda_runtime.h>

#include "gpu/bodies.h"
#include "gpu/cuda_error.h"
#include "gpu/cuda_launch.h"
#include "gpu/cuda_team.cuh"

namespace dmoscope::gpu {

inline constexpr unsigned kBlock = 128;  // threads
/// Least number of blocks on a multiprocessor. Left to itself ptxas caps some kernels at 80, 96 or 128 registers, and spills; with two
/// blocks all may have 255, with three 168, which is enough for small fans alone.
inline constexpr unsigned kBlocksAtOnce = 2;
template <class Body>
inline constexpr unsigned kBlocksAtOnceOf = kBlocksAtOnce;
template <Metric M>
inline constexpr unsigned kBlocksAtOnceOf<bodies::Visit<M, Stars::SmallFans>> = 3;

template <class Body, class Team>
__global__ void __launch_bounds__(kBlock, kBlocksAtOnceOf<Body>) kernel(const __grid_constant__ Task task, std::size_t count) {
  const std::size_t i = (std::size_t{blockIdx.x} * kBlock + threadIdx.x) / Team::kSize;
  if (i < count) Body::run(task, i, count, Team{});
}

/// Runs Count's lanes, each block into counters of its own first: most elements fall into a few bins, whose counters the whole device
/// would else wait for.
template <class Slots>
__global__ void __launch_bounds__(kBlock, kBlocksAtOnce) count_kernel(const __grid_constant__ Task task, std::size_t count) {
  __shared__ std::uint32_t counts[Slots::kCount];
  for (unsigned slot = threadIdx.x; slot < Slots::kCount; slot += kBlock) counts[slot] = 0;
  __syncthreads();
  const std::size_t first = std::size_t{blockIdx.x} * (kBlock * Slots::kEach) + threadIdx.x;
  for (std::size_t k = 0; k < Slots::kEach; ++k) {
    const std::size_t i = first + k * kBlock;
    if (i < count) atomicAdd(counts + Slots::of(task, i), 1U);
  }
  __syncthreads();
  for (unsigned slot = threadIdx.x; slot < Slots::kCount; slot += kBlock)
    if (counts[slot] != 0) atomicAdd(task.counts + slot, counts[slot]);
}

using Kernel = void (*)(const Task task, std::size_t count);
inline void start(Kernel kernel, std::size_t blocks, const Task& task, std::size_t count, cudaStream_t stream) {
  void* arguments[] = {const_cast<Task*>(&task), &count};
  // Not <<<>>>, whose status would be that of whatever failed last on this thread.
  DMOSCOPE_CUDA_CHECK(cudaLaunchKernel(kernel, dim3(static_cast<unsigned>(blocks)), dim3(kBlock), arguments, 0, stream));
}

template <class Body, class Team>
void launch(const Task& task, std::size_t count, cudaStream_t stream) {
  start(kernel<Body, Team>, (count * Team::kSize + kBlock - 1) / kBlock, task, count, stream);
}

}  // namespace dmoscope::gpu
