#pragma once
// Directional vertex relaxation (Rangarajan and Lew 2017): every vertex goes to the best place on a line through it; all lines of an
// iteration have one direction.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// Direction of an iteration's lines in the mesh's plane, of length 1 up to rounding: it follows from the options and the iteration alone.
[[nodiscard]] Vec2<double> dvr_direction(const MethodOptions& options, std::uint64_t iteration);

/// Direction of an iteration's lines in space, of length 1 up to rounding.
[[nodiscard]] Vec3 volume_dvr_direction(const MethodOptions& options, std::uint64_t iteration);

/// Makes the smoother. See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_dvr_smoother(const SmoothingTask& task);

}  // namespace dmoscope
