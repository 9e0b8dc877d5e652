#pragma once
// What raising the worst element costs the others, and what gets it back.

#include <string>

#include "core/run/run.h"

namespace dmoscope {

/// "the mean fell from 0.957 (iteration 2) to 0.844 for the sake of the worst element; a second phase raises it and keeps the minimum".
/// Empty where the mean has not fallen by more than 0.02 since no element has been inverted, and of a run that raises the
/// mean, has two aims, or does not optimise.
[[nodiscard]] std::string mean_given_up(const Run& run);

}  // namespace dmoscope
