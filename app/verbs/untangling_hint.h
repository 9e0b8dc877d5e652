#pragma once
// Where a method leaves elements inverted: does another get further?

#include <memory>
#include <string>

#include "core/session/run.h"

namespace dmoscope::app {

/// "angle-based leaves 0 of them after 12 iterations: try --method angle-based"; empty where none of those that cost little leaves fewer
/// than `run`. Tries each from the input on, with the run's other parameters; some 2 million visits each at most. Throws Cancelled.
[[nodiscard]] std::string untangling_hint(const Run& run, std::shared_ptr<const InputMesh> input, std::shared_ptr<ThreadPool> pool,
                                          Progress& progress);

}  // namespace dmoscope::app
