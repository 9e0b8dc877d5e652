#pragma once
// What a run asks a smoother for, and whether that can be.

#include <memory>
#include <string>

#include "core/run/parameters.h"

namespace dmoscope {

/// As far as the parameters say it, which it looks into: without colouring, sizes, domain and pool.
[[nodiscard]] SmoothingTask task_of(std::shared_ptr<const InputMesh> input, const RunParameters& parameters);

/// Why no run can be by these parameters: what Run refuses them with. Empty: one can.
[[nodiscard]] std::string why_no_run(std::shared_ptr<const InputMesh> input, const RunParameters& parameters,
                                     const Acceleration& acceleration = {});

}  // namespace dmoscope
