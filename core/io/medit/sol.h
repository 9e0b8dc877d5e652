#pragma once
// MEDIT's solution files, .sol: numbers at a mesh's vertices, above all metrics, which mmg and others write beside it.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Reads the solutions at vertices as fields of the mesh: "sol" (a number), "sol-vector", "metric" (a symmetric tensor: 3 components in the
/// plane, 6 in space, in mmg's order), with a number behind the name if there are several of a kind. Returns the keywords that were
/// skipped, with their numbers: those that do not concern vertices. Throws InputError (file and line), Cancelled.
std::vector<std::string> read_solutions(const std::filesystem::path& file, Mesh& mesh, Progress& progress);

/// Reads the solutions in "part.sol", if the mesh is "part.mesh" or "part.mesh.gz" and such a file is beside it; a note says so, or why it
/// was not read.
void read_solutions_beside(SourceFile& source, Mesh& mesh, Progress& progress);
/// The solution file beside a mesh, if there is one.
[[nodiscard]] std::vector<std::filesystem::path> solutions_beside(const SourceFile& source, const IoContext& context);

}  // namespace dmoscope
