#pragma once
// MEDIT's solution files, .sol: what mmg and others write beside a mesh, numbers at its vertices; above all metrics.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Reads the solutions at vertices as fields of the mesh: "sol" (a number), "sol-vector", "metric" (a symmetric tensor: 3 components in the
/// plane, 6 in space, as mmg orders them), with a number behind the name where there are several of a kind. Returns the keywords that were
/// passed over with their numbers: those that say nothing of vertices. Throws InputError (file and line), Cancelled.
std::vector<std::string> read_solutions(const std::filesystem::path& file, Mesh& mesh, Progress& progress);

/// Those in "part.sol", where the mesh is "part.mesh" or "part.mesh.gz" and such a file lies beside it; a note says so, or why it was not
/// read.
void read_solutions_beside(SourceFile& source, Mesh& mesh, Progress& progress);
/// That file, if it is there.
[[nodiscard]] std::vector<std::filesystem::path> solutions_beside(const SourceFile& source, const IoContext& context);

}  // namespace dmoscope
