#include "core/mesh/named_lists.h"

#include <algorithm>

namespace dmoscope {

bool is_string(const Group& group) { return group.dimension == 0 && group.role.ends_with("boundary"); }

bool is_required(const Group& group) {
  constexpr std::string_view kBegins = "required";
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return group.role == "mark" && group.name.size() >= kBegins.size() &&
         std::equal(kBegins.begin(), kBegins.end(), group.name.begin(), [&](char a, char b) { return a == small(b); });
}

namespace {

/// Calls visit(corners) for every edge or face of an element that has this vertex, edges of volume elements more than once; stops when it
/// returns false, and returns that.
template <class Visit>
bool for_parts(const ElementTable& elements, Index element, Index vertex, NamedKind kind, const Visit& visit) {
  const auto corners = elements.corners(element);
  const auto edges = [&](std::span<const Index> loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::array<Index, 2> edge{loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]};
      if ((edge[0] == vertex || edge[1] == vertex) && !visit(std::span<const Index>(edge))) return false;
    }
    return true;
  };
  const auto faces = faces_of(elements.kind(element));
  if (faces.empty()) return kind == NamedKind::Faces || edges(corners);
  for (const LocalFace& face : faces) {
    std::array<Index, 4> loop{};
    for (std::size_t i = 0; i < face.count; ++i) loop[i] = corners[face.corners[i]];
    const std::span<const Index> used(loop.data(), face.count);
    if (std::ranges::find(used, vertex) == used.end()) continue;
    if (kind == NamedKind::Faces ? !visit(used) : !edges(used)) return false;
  }
  return true;
}

}  // namespace

NamedList::NamedList(NamedKind kind, std::span<const Group* const> groups, const Mesh& mesh, const Topology& topology)
    : kind_(kind), mesh_(mesh), topology_(topology), is_full_(mesh.positions.size(), 0) {
  if (kind == NamedKind::Points) named_.assign(mesh.positions.size(), 0);
  for (const Group* group : groups) add(*group);
  std::ranges::sort(keys_);
}

void NamedList::add(const Group& group) {
  if (kind_ == NamedKind::Points) {
    for (const Index v : group.members) named_[v] = 1;
  } else if (kind_ == NamedKind::Lines) {
    for (std::size_t i = 0; i + 1 < group.members.size(); i += 2) add(std::span(group.members).subspan(i, 2));
  } else {
    for (Index f = 0; f < group.faces.size(); ++f) add(group.faces.corners(f));
  }
}

bool NamedList::named(std::span<const Index> corners) const { return std::ranges::binary_search(keys_, corner_set(corners)); }

bool NamedList::all_named_at(Index vertex) const {
  for (const Incidence& at : topology_.star(vertex)) {
    if (kind_ == NamedKind::Points) {
      if (!std::ranges::all_of(mesh_.elements.corners(at.element), [&](Index v) { return named_[v] != 0; })) return false;
    } else if (!for_parts(mesh_.elements, at.element, vertex, kind_, [&](std::span<const Index> part) { return named(part); })) {
      return false;
    }
  }
  return true;
}

bool NamedList::full(Index vertex) {
  std::uint8_t& known = is_full_[vertex];
  if (known == 0) known = all_named_at(vertex) ? 2 : 1;
  return known == 2;
}

bool NamedList::surrounds(Index vertex) {
  if (!full(vertex)) return false;
  for (const Incidence& at : topology_.star(vertex)) {
    for (const Index v : mesh_.elements.corners(at.element))
      if (!full(v)) return false;
  }
  return true;
}

}  // namespace dmoscope
