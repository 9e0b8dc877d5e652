#pragma once
// Choice of the fast search of single vertices that replaces the plain grid search.

#include <memory>

#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/star_kernel.h"

namespace dmoscope {

/// Returns whether the search is that of KernelSet::target_lanes or target_volume, which are for the mean ratio against targets.
[[nodiscard]] bool has_target_kernel(const InputMesh& input, Metric metric, const SearchParameters& parameters);

/// Kernel for the free vertices of a task that aim at an objective; null: the plain search alone. Frame: Plane or Space.
template <class Frame>
[[nodiscard]] std::shared_ptr<const StarKernel<Frame>> star_kernel(const SmoothingTask& task, const CompositeObjective& objective);

}  // namespace dmoscope
