#pragma once
// DMO on the CPU (paper, Algorithm 1): the grid search for each vertex, confirmed in double before the vertex moves.

#include <memory>

#include "core/smooth/reference_visit.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

/// How good the star of `vertex` is.
[[nodiscard]] StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex);

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task);

}  // namespace dmoscope
