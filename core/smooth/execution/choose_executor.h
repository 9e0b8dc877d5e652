#pragma once
// Who will smooth, before anybody does.

#include "core/smooth/execution/executor.h"

namespace dmoscope {

/// As make_executor, but on the CPU without a smoother: a big mesh that is only looked at needs none. Whoever smooths makes it, see
/// make_smoother.
[[nodiscard]] Executor choose_executor(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task);

}  // namespace dmoscope
