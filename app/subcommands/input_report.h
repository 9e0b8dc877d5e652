#pragma once
// Findings about the mesh that a subcommand reads, the vertices that the user names, and lists of its groups and data.

#include <cstddef>
#include <string>
#include <vector>

#include "app/common/text.h"
#include "core/mesh/mesh.h"
#include "core/mesh/outline.h"
#include "core/run/run.h"
#include "core/run/selections.h"

namespace dmoscope::app {

/// Writes sentences about the mesh to standard error, the orientation's first, and returns them.
std::vector<std::string> tell_findings(const InputMesh& input);

/// Writes which vertices interfaces fix, if any by these parameters, to standard error and to `warnings`.
void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings);

/// Finds corners and feature edges by kinds_of(); writes its warnings to standard error, too. Throws UsageError.
[[nodiscard]] Kinds tell_kinds(const InputMesh& input, const RunParameters& parameters, const Selections& selections,
                               std::vector<std::string>& warnings);

/// Prints a line for each group: kind, dimension, id, name, kind and number of its members. Nothing for a mesh without groups. Beyond
/// `most` one line tells how many more there are.
void print_groups(const Mesh& mesh, std::size_t most);
/// Prints a line for each field: name, its place (vertices or elements), components, and whether it names materials.
void print_fields(const Mesh& mesh);

/// The groups as [{"kind", "dimension", "id", "type", "name", "members", "count", "vertices"}]; id and type are null if there is none.
[[nodiscard]] Json json_of_groups(const Mesh& mesh);
/// The fields as [{"name", "of", "components", "names_materials"}].
[[nodiscard]] Json json_of_fields(const Mesh& mesh);

/// Prints a line for each boundary loop and, if there are several, for each connected part; nothing for one part without loops.
void print_outline(const Outline& outline);
/// The outline as {"boundary_loops": [{"name", "part", "outer", "vertices", "length", "area"}], "parts": [{"elements", "vertices", "loops",
/// "area"}], "left_out"}; parts count from 1, as in the words of --fix.
[[nodiscard]] Json json_of_outline(const Outline& outline);

}  // namespace dmoscope::app
