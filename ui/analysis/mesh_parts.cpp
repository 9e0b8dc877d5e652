#include "ui/analysis/mesh_parts.h"

#include <algorithm>
#include <chrono>

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

const Outline* OutlineSource::of(const std::shared_ptr<const InputMesh>& input) {
  constexpr Index kBig = 50'000;  // elements; half-edges of larger meshes take long enough to be felt
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    outline_ = pending_.get();
  }
  if (input_ != input) {
    input_ = input;
    outline_.reset();
    const auto work = [input] { return std::make_shared<const Outline>(outline_of(input->mesh)); };
    if (input->mesh.elements.size() < kBig) {
      outline_ = work();
    } else {
      pending_ = std::async(std::launch::async, work);
    }
  }
  return outline_.get();
}

}  // namespace dmoscope::ui
