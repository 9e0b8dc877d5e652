#pragma once
// Lists of a mesh's groups and data, as the subcommands print them.

#include <cstddef>

#include "app/common/text.h"
#include "core/mesh/mesh.h"
#include "core/mesh/outline.h"

namespace dmoscope::app {

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
