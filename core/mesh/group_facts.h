#pragma once
// What a mesh's groups are called and how large they are, as lists show them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

struct GroupFacts {
  std::string kind;           // the file's own word: "physical group", "reference", "marker", "land boundary"; "group" where it has none
  std::string_view of;        // what its members are: "points", "lines", "faces" (of a volume) or "elements"
  int dimension = 0;          // of its members, 0 to 3
  std::optional<int> number;  // by which the file calls it
  std::optional<int> type;    // of a boundary string of a fort.14 (IBTYPE)
  std::string name;
  std::size_t members = 0;
  Index vertices = 0;  // different ones
};

/// One for each of mesh.groups, in their order.
[[nodiscard]] std::vector<GroupFacts> facts_of_groups(const Mesh& mesh);

/// What a group's members are: "points", "lines", "faces" or "elements".
[[nodiscard]] std::string_view members_of(const Group& group) noexcept;
/// The number by which the file calls a group; none where it only names it. Types of boundaries, which repeat, are none.
[[nodiscard]] std::optional<int> number_of(const Group& group);
/// All vertices of a group, also of one of elements; some more than once.
[[nodiscard]] std::vector<Index> vertices_of(const Mesh& mesh, const Group& group);

}  // namespace dmoscope
