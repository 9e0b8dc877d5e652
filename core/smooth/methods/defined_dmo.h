#pragma once
// Smoothing by a metric that is defined by a formula or a target.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// dmo, of planar meshes and volumes. See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_defined_dmo_smoother(const SmoothingTask& task);
/// Is the search that of target_lane_kernel() or target_volume_kernel()? It is for the mean ratio against targets.
[[nodiscard]] bool has_target_kernel(const InputMesh& input, Metric metric, const SearchParameters& parameters);

}  // namespace dmoscope
