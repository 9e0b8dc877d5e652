#pragma once
// What a verb tells about the mesh it read: the findings, and the set of vertices a person named.

#include <string>
#include <vector>

#include "core/session/input_mesh.h"

namespace dmoscope::app {

/// Sentences about the mesh, the orientation's first; each also goes to standard error.
std::vector<std::string> tell_findings(const InputMesh& input);

/// Vertices of `texts`, each a list of 0-based ids and ranges ("3,7-9") or the name of a group of the mesh (its vertices, the ends
/// of its edges, or the corners of its elements); a group's name goes before a list. Sorted, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> named_vertices(const Mesh& mesh, const std::vector<std::string>& texts);

}  // namespace dmoscope::app
