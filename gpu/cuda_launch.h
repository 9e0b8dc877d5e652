#pragma once
// From kinds of work to kernels. Plain C++ for who launches; cuda_launch.cuh defines it, metric by metric, so that they compile side by
// side.

#include <cstddef>

#include "core/quality/metric.h"
#include "gpu/work.h"

using cudaStream_t = struct CUstream_st*;

namespace dmoscope::gpu {

struct Task;

/// Starts the kernel on `stream` of the current device, for lanes or teams 0 to count - 1; count > 0. Throws CudaError.
using Launcher = void (*)(const Task& task, std::size_t count, cudaStream_t stream);

/// Of the kinds of work that depend on a metric: Visit, VisitInTeam, Settle, Judge.
template <Metric M>
[[nodiscard]] Launcher metric_launcher(Work work);
/// Of those of volumes: VisitVolume, JudgeVolume.
template <Metric M>
[[nodiscard]] Launcher volume_launcher(Work work);
/// Of the others.
[[nodiscard]] Launcher plain_launcher(Work work);

}  // namespace dmoscope::gpu
