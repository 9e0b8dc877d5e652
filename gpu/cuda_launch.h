#pragma once
// From kinds of work to kernels. Plain C++ for the callers; kernels_*.cu define it, so that the parts compile side by side.

#include <cstddef>

#include "core/quality/metric.h"
#include "gpu/work.h"

using cudaStream_t = struct CUstream_st*;

namespace dmoscope::gpu {

struct Task;

/// Starts the kernel on `stream` of the current device, for lanes or teams 0 to count - 1; count > 0. Throws CudaError.
using Launcher = void (*)(const Task& task, std::size_t count, cudaStream_t stream);

/// Kernels that depend on a metric compile side by side in this many parts (kernels_metrics_PART.cu): metric number i in part i %
/// kMetricParts.
inline constexpr std::size_t kMetricParts = 5;
/// Launches work that depends on a metric, which has code of its own for planar or volume elements, as the work needs. I: of the first
/// metric to compare with.
template <std::size_t Part, std::size_t I = Part>
[[nodiscard]] Launcher part_launcher(Metric metric, Work work);
/// Launches work by metrics that are defined by formulas or targets. Frame: Plane or Space. `in_double`: the search is.
template <class Frame>
[[nodiscard]] Launcher defined_launcher(Work work, bool in_double);
/// Launches work by the mean ratio against targets. `crossed`: see TargetForm.
[[nodiscard]] Launcher target_launcher(Work work, bool crossed);
/// Launches all other work.
[[nodiscard]] Launcher plain_launcher(Work work);

}  // namespace dmoscope::gpu
