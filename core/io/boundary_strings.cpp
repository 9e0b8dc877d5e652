#include "core/io/boundary_strings.h"

#include <fmt/format.h>

namespace dmoscope {
namespace {

/// Is a closed island the type of this land boundary of a fort.14?
bool is_island(const Group& group) { return group.role == "land boundary" && (group.code == 1 || group.code == 11 || group.code == 21); }

}  // namespace

bool is_boundary_string(const Group& group) {
  return group.dimension == 0 && (group.role == "open boundary" || group.role == "land boundary");
}

std::vector<Index> chain_edges(const Group& group) {
  std::vector<Index> edges;
  for (std::size_t i = 1; i < group.members.size(); ++i) {
    edges.push_back(group.members[i - 1]);
    edges.push_back(group.members[i]);
  }
  if (is_island(group) && group.members.size() > 2 && group.members.front() != group.members.back()) {
    edges.push_back(group.members.back());
    edges.push_back(group.members.front());
  }
  return edges;
}

std::vector<Group> groups_with_edges(const Mesh& mesh, std::string_view written_as, Notes& notes) {
  std::vector<Group> groups = mesh.groups;
  for (Group& group : groups) {
    if (!is_boundary_string(group) || group.members.size() < 2) continue;
    notes.push_back(
        fmt::format("The {} \"{}\" (type {}) was written as a {} of its edges.", group.role, group.name, group.code, written_as));
    group.members = chain_edges(group);
    group.dimension = 1;
    group.code = 0;  // types repeat: as numbers they would mean nothing
  }
  return groups;
}

}  // namespace dmoscope
