#include "ui/analysis/group_list.h"

#include <algorithm>

#include <fmt/format.h>

#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

std::string category_of(const Group& group, bool many) {
  if (!many) return group.name;
  return group.code != 0 ? fmt::format("{}, type {}", group.role, group.code) : group.role;
}

std::vector<GroupLine> group_lines(const Mesh& mesh) {
  std::vector<GroupFacts> facts = facts_of_groups(mesh);
  const bool of_elements = std::ranges::any_of(mesh.groups, &Group::of_elements);
  const bool many = mesh.groups.size() > kMostGroupCategories;
  std::vector<std::string> categories;
  std::vector<GroupLine> lines;
  for (std::size_t g = 0; g < facts.size(); ++g) {
    const Group& group = mesh.groups[g];
    GroupLine line{std::move(facts[g]), fmt::format("{}:{}", members_of(group), group.name), std::nullopt};
    if (group.of_elements() == of_elements) {  // matches the mesh coloured by group: by elements if there are groups of elements
      const std::string category = category_of(group, many);
      const auto at = std::ranges::find(categories, category);
      line.colour = category_colour(static_cast<std::size_t>(at - categories.begin()));
      if (at == categories.end()) categories.push_back(category);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace dmoscope::ui
