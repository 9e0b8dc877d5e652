#pragma once
// Which fast search of single vertices stands in for the plain grid search.

#include <memory>

#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/star_kernel.h"

namespace dmoscope {

/// Is the search that of KernelSet::target_lanes or target_volume? It is for the mean ratio against targets.
[[nodiscard]] bool has_target_kernel(const InputMesh& input, Metric metric, const SearchParameters& parameters);

/// For the free vertices of a task that aim at an objective; null: the plain search alone. Frame: Plane or Space.
template <class Frame>
[[nodiscard]] std::shared_ptr<const StarKernel<Frame>> star_kernel(const SmoothingTask& task, const CompositeObjective& objective);

}  // namespace dmoscope
