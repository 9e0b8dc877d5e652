#include "core/io/mesh_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dmoscope {

namespace {

/// Whether the type of this land boundary of a fort.14 is a closed island.
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

void note_boundary_strings(std::span<const Group* const> strings, std::string_view written_as, std::string_view written_as_many,
                           Notes& notes) {
  std::vector<std::string_view> roles;
  for (const Group* group : strings) {
    if (std::ranges::find(roles, group->role) == roles.end()) roles.emplace_back(group->role);
  }
  for (const std::string_view role : roles) {
    std::vector<const Group*> alike;
    std::ranges::copy_if(strings, std::back_inserter(alike), [&](const Group* group) { return group->role == role; });
    const Group& first = *alike.front();
    if (alike.size() == 1) {
      notes.push_back(fmt::format("The {} \"{}\" (type {}) was written as a {} of its edges.", role, first.name, first.code, written_as));
      continue;
    }
    std::set<int> types;
    for (const Group* group : alike) types.insert(group->code);
    // Forms the plural: both roles end in "boundary".
    notes.push_back(fmt::format("{} {}ies (\"{}\" to \"{}\", of type{} {}) were written as {} of their edges.", alike.size(),
                                role.substr(0, role.size() - 1), first.name, alike.back()->name, types.size() == 1 ? "" : "s",
                                fmt::join(types, ", "), written_as_many));
  }
}

std::vector<Group> groups_with_edges(const Mesh& mesh, std::string_view written_as, Notes& notes) {
  std::vector<Group> groups = mesh.groups;
  std::vector<const Group*> strings;
  for (const Group& group : mesh.groups) {
    if (is_boundary_string(group) && group.members.size() >= 2) strings.push_back(&group);
  }
  note_boundary_strings(strings, written_as, fmt::format("{}s", written_as), notes);
  for (Group& group : groups) {
    if (!is_boundary_string(group) || group.members.size() < 2) continue;
    group.members = chain_edges(group);
    group.dimension = 1;
    group.code = 0;  // types repeat, so they cannot serve as numbers
  }
  return groups;
}

std::optional<std::vector<int>> whole_values(const Field& field, double least) {
  std::vector<int> wholes;
  wholes.reserve(field.values.size());
  for (const double v : field.values) {
    if (v != std::nearbyint(v) || v < least || v > 2147483647.0) return std::nullopt;
    wholes.push_back(static_cast<int>(v));
  }
  return wholes;
}

}  // namespace dmoscope
