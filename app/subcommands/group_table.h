#pragma once
// A mesh's groups and data as the subcommands list them.

#include <cstddef>

#include "app/common/text.h"
#include "core/mesh/mesh.h"
#include "core/mesh/outline.h"

namespace dmoscope::app {

/// A line for each group: kind, dimension, id, name, what its members are and how many. Nothing for a mesh without groups. Beyond `most`
/// one line says how many more there are.
void print_groups(const Mesh& mesh, std::size_t most);
/// A line for each field: name, of what, numbers each, and whether it names materials.
void print_fields(const Mesh& mesh);

/// [{"kind", "dimension", "id", "type", "name", "members", "count", "vertices"}]; id and type are null where there is none.
[[nodiscard]] Json json_of_groups(const Mesh& mesh);
/// [{"name", "of", "components", "names_materials"}]
[[nodiscard]] Json json_of_fields(const Mesh& mesh);

/// A line for each boundary loop and, where there are several, for each connected part; nothing where there are no loops and one part.
void print_outline(const Outline& outline);
/// {"boundary_loops": [{"name", "part", "outer", "vertices", "length", "area"}], "parts": [{"elements", "vertices", "loops", "area"}],
/// "left_out"}; parts count from 1 as the words of --fix have them.
[[nodiscard]] Json json_of_outline(const Outline& outline);

}  // namespace dmoscope::app
