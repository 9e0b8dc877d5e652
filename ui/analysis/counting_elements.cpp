#include "ui/analysis/counting_elements.h"

#include <algorithm>
#include <charconv>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "ui/analysis/mesh_parts.h"
#include "ui/analysis/run_colours.h"

namespace dmoscope::ui {
namespace {

std::optional<std::size_t> number_in(std::string_view name, bool& open) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc()) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(name.data() + name.size() - end));
  open = rest == " or more";
  return rest.empty() || open ? std::optional(number) : std::nullopt;
}

bool is_named(const Group& group, std::string_view name) {
  return group.name == name || group.role == name || category_of(group, true) == name;
}

/// Marks elements with a corner among the vertices.
void mark_around(const Mesh& mesh, const std::vector<std::uint8_t>& vertices, std::vector<std::uint8_t>& elements) {
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    elements[e] = std::any_of(corners.begin(), corners.end(), [&](Index v) { return vertices[v] != 0; }) ? 1 : 0;
  }
}

std::vector<std::uint8_t> members_of_group(const Mesh& mesh, const std::string& name) {
  std::vector<std::uint8_t> elements(mesh.elements.size(), 0), vertices(mesh.positions.size(), 0);
  bool exact = false;  // a group of that name has priority over the role of that name
  for (const Group& group : mesh.groups) exact = exact || group.name == name;
  for (const Group& group : mesh.groups) {
    if (exact ? group.name != name : !is_named(group, name)) continue;
    auto& marked = group.of_elements() ? elements : vertices;
    for (const Index member : group.of_elements() ? std::span<const Index>(group.members) : group.vertices()) {
      if (member < marked.size()) marked[member] = 1;
    }
  }
  std::vector<std::uint8_t> around(elements.size(), 0);
  mark_around(mesh, vertices, around);
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = elements[e] != 0 || around[e] != 0 ? 1 : 0;
  return elements;
}

std::vector<std::uint8_t> members_of_isolation(const Isolation& isolation, const Frame& frame, const RunView* run) {
  const Colouring* classes = run == nullptr ? nullptr : run->colouring.get();
  const Mesh& mesh = frame.input->mesh;
  std::vector<std::uint8_t> elements(mesh.elements.size(), 0);
  bool open = false;
  const std::optional<std::size_t> number = number_in(isolation.name, open);
  std::vector<std::uint8_t> vertices(mesh.positions.size(), 0);
  switch (isolation.by) {
    case ColourBy::Kind:
      for (Index e = 0; e < elements.size(); ++e) elements[e] = info(mesh.elements.kind(e)).name == isolation.name ? 1 : 0;
      break;
    case ColourBy::Group:
      elements = members_of_group(mesh, isolation.name);
      break;
    case ColourBy::Valence:
      for (Index v = 0; number && v < vertices.size(); ++v) {
        const std::size_t valence = frame.input->topology.star(v).size();
        vertices[v] = valence == *number || (open && valence > *number) ? 1 : 0;
      }
      mark_around(mesh, vertices, elements);
      break;
    case ColourBy::Class:
      if (classes != nullptr && number && *number >= 1 && *number <= classes->class_count()) {
        for (const Index v : classes->members(static_cast<Index>(*number - 1))) vertices[v] = 1;
      }
      mark_around(mesh, vertices, elements);
      break;
    case ColourBy::Freedom:
      if (run != nullptr && run->fixed.size() == vertices.size()) {
        const auto freedom = freedom_of_elements(mesh, {run->fixed.data(), run->fixed.size()}, run->domain.get());
        for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = kFreedoms[freedom[e]] == isolation.name ? 1 : 0;
      }
      break;
    case ColourBy::Inverted:
      if (frame.inverted.size() == elements.size()) elements = frame.inverted;
      break;
    default:
      elements.assign(elements.size(), 1);
  }
  return elements;
}

}  // namespace

std::optional<std::string> why_unknown(const Isolation& isolation, const InputMesh& input) {
  const auto among = [&](const std::vector<std::string>& names, const char* what) -> std::optional<std::string> {
    if (std::find(names.begin(), names.end(), isolation.name) != names.end()) return std::nullopt;
    constexpr std::size_t kMostNames = 12;
    std::string list;
    for (std::size_t k = 0; k < std::min(names.size(), kMostNames); ++k) list += (k == 0 ? "" : ", ") + names[k];
    if (names.size() > kMostNames) list += fmt::format(" and {} more", names.size() - kMostNames);
    return fmt::format("the mesh has no {} \"{}\"; it has {}", what, isolation.name, list.empty() ? "none" : list);
  };
  std::vector<std::string> names;
  bool open = false;
  switch (isolation.by) {
    case ColourBy::Kind:
      for (std::size_t kind = 0; kind < kElementKindCount; ++kind) {
        const auto kinds = input.mesh.elements.kinds();
        const auto one = static_cast<ElementKind>(kind);
        if (std::find(kinds.begin(), kinds.end(), one) != kinds.end()) names.emplace_back(dmoscope::info(one).name);
      }
      return among(names, "elements of the kind");
    case ColourBy::Group:
      for (const Group& group : input.mesh.groups) {
        if (is_named(group, isolation.name)) return std::nullopt;
        names.push_back(group.name);
      }
      return among(names, "group or marker");
    case ColourBy::Valence:
    case ColourBy::Class:
      if (number_in(isolation.name, open)) return std::nullopt;
      return fmt::format("\"{}\": expected a number", isolation.name);
    case ColourBy::Freedom:
      if (std::ranges::find(kFreedoms, isolation.name) != kFreedoms.end()) return std::nullopt;
      names.assign(kFreedoms.begin(), kFreedoms.end());
      return among(names, "elements that are");
    default:
      return std::nullopt;
  }
}

std::shared_ptr<const std::vector<std::uint8_t>> members_of(const ColouringState& state, const Frame& frame, const RunView* run) {
  if (!state.isolated && state.worst == 0) return nullptr;
  const std::size_t size = frame.element_count();
  auto members = std::make_shared<std::vector<std::uint8_t>>(size, std::uint8_t{1});
  if (state.isolated) *members = members_of_isolation(*state.isolated, frame, run);
  if (state.worst > 0) {
    std::vector<std::uint8_t> among(size, 0);
    const std::size_t most = std::min(frame.worst.size(), static_cast<std::size_t>(state.worst));
    for (std::size_t k = 0; k < most; ++k) among[frame.worst[k].element] = (*members)[frame.worst[k].element];
    *members = std::move(among);
  }
  return members;
}

}  // namespace dmoscope::ui
