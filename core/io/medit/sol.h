#pragma once
// MEDIT's solution files, .sol: what mmg and others write beside a mesh, numbers at its vertices; above all metrics.

#include <filesystem>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// "part.mesh": "part.sol".
[[nodiscard]] std::filesystem::path solution_beside(const std::filesystem::path& mesh);

/// Reads the solutions at vertices as fields of the mesh: "sol" (a number), "sol-vector", "metric" (a symmetric tensor: 3 components in the
/// plane, 6 in space, as mmg orders them), with a number behind the name where there are several of a kind. Throws InputError (file and
/// line), Cancelled.
void read_solutions(const std::filesystem::path& file, Mesh& mesh, Progress& progress);

}  // namespace dmoscope
