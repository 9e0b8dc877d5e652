#pragma once
// Names and sizes of a mesh's groups, as lists show them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

struct GroupFacts {
  std::string kind;           // the file's own word: "physical group", "reference", "marker", "land boundary"; "group" where it has none
  std::string_view of;        // kind of its members: "points", "lines", "faces" (of a volume) or "elements"
  int dimension = 0;          // dimension of its members, 0 to 3
  std::optional<int> number;  // number that the file gives the group
  std::optional<int> type;    // type of a boundary string of a fort.14 (IBTYPE)
  std::string name;
  std::size_t members = 0;
  Index vertices = 0;  // number of distinct vertices
};

/// Facts of each of mesh.groups, in their order.
[[nodiscard]] std::vector<GroupFacts> facts_of_groups(const Mesh& mesh);

/// Kind of a group's members: "points", "lines", "faces" or "elements".
[[nodiscard]] std::string_view members_of(const Group& group) noexcept;
/// The number that the file gives a group; none if it only names it. Types of boundaries, which repeat, are no such numbers.
[[nodiscard]] std::optional<int> number_of(const Group& group);
/// All vertices of a group, with the corners of a group of elements; some more than once.
[[nodiscard]] std::vector<Index> vertices_of(const Mesh& mesh, const Group& group);

}  // namespace dmoscope
