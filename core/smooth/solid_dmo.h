#pragma once
// DMO in volumes, for speed.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_solid_dmo_smoother(const SmoothingTask& task);

}  // namespace dmoscope
