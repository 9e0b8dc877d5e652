#pragma once
// From kinds of work to kernels. Plain C++ for the callers; cuda_launch.cuh defines it, metric by metric, so that the parts compile
// side by side.

#include <cstddef>

#include "core/quality/metric.h"
#include "gpu/work.h"

using cudaStream_t = struct CUstream_st*;

namespace dmoscope::gpu {

struct Task;

/// Starts the kernel on `stream` of the current device, for lanes or teams 0 to count - 1; count > 0. Throws CudaError.
using Launcher = void (*)(const Task& task, std::size_t count, cudaStream_t stream);

/// Launches VisitComposite, VisitVolumeComposite.
template <Metric M>
[[nodiscard]] Launcher composite_launcher();
template <Metric M>
[[nodiscard]] Launcher volume_composite_launcher();
/// Launches work that depends on a metric: Visit, VisitInTeam, VisitComposite, Settle, Judge.
template <Metric M>
[[nodiscard]] Launcher metric_launcher(Work work);
/// Launches work on volumes: VisitVolume, VisitVolumeComposite, JudgeVolume.
template <Metric M>
[[nodiscard]] Launcher volume_launcher(Work work);
/// Launches work by metrics that are defined by formulas or targets. Frame: Plane or Space. `in_double`: the search is.
template <class Frame>
[[nodiscard]] Launcher defined_launcher(Work work, bool in_double);
/// Launches work by the mean ratio against targets. `crossed`: see TargetForm.
[[nodiscard]] Launcher target_launcher(Work work, bool crossed);
/// Launches all other work.
[[nodiscard]] Launcher plain_launcher(Work work);

}  // namespace dmoscope::gpu
