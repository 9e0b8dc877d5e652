#pragma once
// Boundary strings of fort.14 files, chains of vertices, for formats whose boundaries consist of edges.

#include <span>
#include <string_view>
#include <vector>

#include "core/io/format.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Whether the group is an open or land boundary of a fort.14.
[[nodiscard]] bool is_boundary_string(const Group& group);

/// The edges of a boundary string, two vertices each: each vertex joined with the next, and the last of an island with the first.
[[nodiscard]] std::vector<Index> chain_edges(const Group& group);

/// Notes one sentence for each role among these boundary strings, with the form in which they were written (for one and for several), and
/// their types.
void note_boundary_strings(std::span<const Group* const> strings, std::string_view written_as, std::string_view written_as_many,
                           Notes& notes);

/// The mesh's groups, with boundary strings as groups of their edges; the notes name these. `written_as`: "physical group".
[[nodiscard]] std::vector<Group> groups_with_edges(const Mesh& mesh, std::string_view written_as, Notes& notes);

}  // namespace dmoscope
