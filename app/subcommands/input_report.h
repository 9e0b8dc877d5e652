#pragma once
// What a subcommand tells about the mesh it read: the findings, and the set of vertices a person named.

#include <string>
#include <vector>

#include "app/common/run_options.h"
#include "core/run/run.h"

namespace dmoscope::app {

/// Sentences about the mesh, the orientation's first; each also goes to standard error.
std::vector<std::string> tell_findings(const InputMesh& input);

/// What stays on interfaces, if anything does by these parameters: to standard error and to `warnings`.
void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings);

/// What the words of --fix name, see vertices_named(). Sorted, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_to_fix(const Mesh& mesh, const std::vector<std::string>& words);
/// Sets what --slide and --fix say together; the vertices are those that the words of each name. Throws UsageError.
void fix_and_slide(RunParameters& parameters, const InputMesh& input, const std::vector<Index>& fixed, const std::vector<Index>& sliding);
/// The vertices that the words of --slide name, see vertices_named(). Sorted, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_to_slide(const Mesh& mesh, const std::vector<std::string>& words);
/// The corners and feature edges that --corner and the like name. Says, and adds to `warnings`, what of them does not come true by the
/// parameters; throws UsageError where nothing that an option names does.
[[nodiscard]] Kinds kinds_of(const InputMesh& input, const RunParameters& parameters, const KindWords& words,
                             std::vector<std::string>& warnings);

}  // namespace dmoscope::app
