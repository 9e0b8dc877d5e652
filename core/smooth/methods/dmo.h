#pragma once
// DMO on the CPU (paper, Algorithm 1): the grid search for each vertex, confirmed in double before the vertex moves.

#include <memory>

#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

/// Makes the smoother. See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task);
/// Makes the smoother for another objective than the task's.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task, const CompositeObjective& objective);

}  // namespace dmoscope
