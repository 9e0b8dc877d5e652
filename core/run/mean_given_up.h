#pragma once
// What raising the worst element costs the others, and what gets it back.

#include <cstdint>
#include <span>
#include <string>

#include "core/run/history.h"
#include "core/run/parameters.h"

namespace dmoscope {

/// How minimum and mean stand at the end of an iteration, against the input: "minimum 0.301 -> 0.428, mean 0.781 -> 0.654".
[[nodiscard]] std::string course_text(std::span<const IterationRecord> records, std::uint64_t iteration);

/// "the mean fell from 0.957 (iteration 2) to 0.844 for the sake of the worst element; a second phase raises it and keeps the minimum".
/// Empty where the mean has not fallen by more than 0.005 since no element has been inverted, and of a run that raises the
/// mean, has two aims, or does not optimise. `iteration`: at whose end the run stands.
[[nodiscard]] std::string mean_given_up(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration);

/// Of a method that does not optimise: "laplace made elements worse: the minimum fell from 0.653 to 0.573". Empty where neither the minimum
/// has fallen nor more elements are inverted than at the input.
[[nodiscard]] std::string made_worse(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration);

}  // namespace dmoscope
