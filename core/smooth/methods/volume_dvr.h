#pragma once
// Directional vertex relaxation of volumes; see dvr.h.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// The direction of an iteration's lines in space; see dvr_direction().
[[nodiscard]] Vec3 volume_dvr_direction(const MethodOptions& options, std::uint64_t iteration);

/// DVR for a task whose mesh is a volume. See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_volume_dvr_smoother(const SmoothingTask& task);

}  // namespace dmoscope
