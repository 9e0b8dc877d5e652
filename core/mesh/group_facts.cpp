#include "core/mesh/group_facts.h"

namespace dmoscope {
namespace {

bool has_type(const Group& group) { return group.role.ends_with("boundary"); }

int dimension_of(const Mesh& mesh, const Group& group) {
  if (!group.of_elements()) return group.dimension;
  return group.members.empty() ? 2 : info(mesh.elements.kind(group.members.front())).dimension;
}

std::size_t count_members(const Group& group) {
  if (group.faces.size() > 0) return group.faces.size();
  return group.dimension == 1 ? group.members.size() / 2 : group.members.size();
}

}  // namespace

std::string_view members_of(const Group& group) noexcept {
  if (group.of_elements()) return "elements";
  return group.dimension == 0 ? "points" : group.dimension == 1 ? "lines" : "faces";
}

std::optional<int> number_of(const Group& group) { return has_type(group) || group.code == 0 ? std::nullopt : std::optional(group.code); }

std::vector<Index> vertices_of(const Mesh& mesh, const Group& group) {
  const auto some = group.vertices();
  std::vector<Index> vertices(some.begin(), some.end());
  if (!group.of_elements()) return vertices;
  for (const Index element : group.members) {
    const auto corners = mesh.elements.corners(element);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  return vertices;
}

std::vector<GroupFacts> facts_of_groups(const Mesh& mesh) {
  std::vector<GroupFacts> all;
  std::vector<std::size_t> last_seen(mesh.groups.empty() ? 0 : mesh.positions.size(), mesh.groups.size());  // group of each vertex
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Group& group = mesh.groups[g];
    GroupFacts facts{.kind = group.role.empty() ? "group" : group.role,
                     .of = members_of(group),
                     .dimension = dimension_of(mesh, group),
                     .number = number_of(group),
                     .type = has_type(group) ? std::optional(group.code) : std::nullopt,
                     .name = group.name,
                     .members = count_members(group)};
    for (const Index v : vertices_of(mesh, group)) {
      if (last_seen[v] == g) continue;
      last_seen[v] = g;
      ++facts.vertices;
    }
    all.push_back(std::move(facts));
  }
  return all;
}

}  // namespace dmoscope
