#pragma once
// Text files that declare their points as float (VTK legacy, VTU, PLY) but hold more digits than such a number has. The digits are what
// is judged and kept; programs that take the word instead see the mesh a little otherwise, and a person has to know where that shows.

#include <filesystem>
#include <span>
#include <string>

#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// What they see of the mesh at `positions`, as one sentence; empty where it is no such file, or where the minimum differs by no more
/// than 5e-5 and the number of inverted elements not at all.
[[nodiscard]] std::string seen_as_floats(const InputMesh& input, std::span<const Vec3> positions, Metric metric, ThreadPool* pool);

/// The same of `positions` written to `path`; empty also where that is of another format than the input, which declares what it writes.
[[nodiscard]] std::string written_as_floats(const std::filesystem::path& path, const InputMesh& input, std::span<const Vec3> positions,
                                            Metric metric, ThreadPool* pool);

}  // namespace dmoscope
