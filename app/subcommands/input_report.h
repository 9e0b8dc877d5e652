#pragma once
// Findings about the mesh that a subcommand reads, and the vertices that the user names.

#include <string>
#include <vector>

#include "app/common/run_options.h"
#include "core/run/run.h"

namespace dmoscope::app {

/// Writes sentences about the mesh to standard error, the orientation's first, and returns them.
std::vector<std::string> tell_findings(const InputMesh& input);

/// Writes which vertices interfaces fix, if any by these parameters, to standard error and to `warnings`.
void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings);

/// The vertices that the words of --fix name, see vertices_named(). Sorted, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_to_fix(const Mesh& mesh, const std::vector<std::string>& words);
/// Sets the vertices that --slide and --fix together fix and let slide, given those that the words of each name. Throws UsageError.
void fix_and_slide(RunParameters& parameters, const InputMesh& input, const std::vector<Index>& fixed, const std::vector<Index>& sliding);
/// The vertices that the words of --slide name, see vertices_named(). Sorted, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_to_slide(const Mesh& mesh, const std::vector<std::string>& words);
/// The corners and feature edges that --corner and the like name. Writes those without effect by the parameters to standard error and to
/// `warnings`; throws UsageError if all of an option have none.
[[nodiscard]] Kinds kinds_of(const InputMesh& input, const RunParameters& parameters, const KindWords& words,
                             std::vector<std::string>& warnings);

}  // namespace dmoscope::app
