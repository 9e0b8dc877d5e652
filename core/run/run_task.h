#pragma once
// Task that a run gives a smoother, and whether it is possible.

#include <memory>
#include <string>

#include "core/run/parameters.h"

namespace dmoscope {

/// Task as far as the parameters tell it, which it refers to: without colouring, sizes, domain and pool.
[[nodiscard]] SmoothingTask task_of(std::shared_ptr<const InputMesh> input, const RunParameters& parameters);

/// Reason why these parameters make no run: that for which Run refuses them. Empty: they make one.
[[nodiscard]] std::string why_no_run(std::shared_ptr<const InputMesh> input, const RunParameters& parameters,
                                     const Acceleration& acceleration = {});

}  // namespace dmoscope
