#pragma once
// Choice of an executor before there is a smoother.

#include "core/smooth/execution/executor.h"

namespace dmoscope {

/// Chooses as make_executor does, but on the CPU without a smoother: a big mesh that is only looked at needs none. make_smoother makes it
/// once it is needed.
[[nodiscard]] Executor choose_executor(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task);

}  // namespace dmoscope
