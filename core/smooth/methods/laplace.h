#pragma once
// Laplacian smoothing: each vertex goes to the mean of its edge neighbours, whatever comes of it; or, smart (Freitag 1997), only where it
// gains.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_laplace_smoother(const SmoothingTask& task);
[[nodiscard]] std::unique_ptr<Smoother> make_smart_laplace_smoother(const SmoothingTask& task);

}  // namespace dmoscope
