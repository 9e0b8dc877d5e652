#pragma once
// A second phase after any method's: raises the mean quality without lowering the minimum.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// Smooths as `first` does; a sweep that has a floor raises the mean of the stars above it instead. See Sweep.
[[nodiscard]] std::unique_ptr<Smoother> then_mean(std::unique_ptr<Smoother> first, const SmoothingTask& task);

}  // namespace dmoscope
