#include "core/mesh/collapsed.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/mesh/faces.h"

namespace dmoscope {
namespace {

/// A face by its corners, beginning with the least one. Not of bytes: g++ 12 warns of how it compares vectors of these.
using Polygon = std::vector<std::uint16_t>;

Polygon from_least(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}

/// The remaining faces of a kind whose corner i is corners[i]; none if a face touches itself.
std::optional<std::vector<Polygon>> faces_left(ElementKind kind, const auto& corners) {
  std::vector<Polygon> left;
  for (const LocalFace& face : faces_of(kind)) {
    Polygon polygon;
    for (const Index corner : face.span())
      if (polygon.empty() || polygon.back() != corners[corner]) polygon.push_back(corners[corner]);
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    if (polygon.size() < 3) continue;  // an edge or a point
    Polygon sorted = polygon;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return std::nullopt;
    left.push_back(from_least(std::move(polygon)));
  }
  std::ranges::sort(left);
  return left;
}

std::optional<ElementKind> kind_with(int dimension, std::size_t corners) {
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Tetrahedron, ElementKind::Pyramid, ElementKind::Wedge})
    if (info(kind).dimension == dimension && info(kind).corners == corners) return kind;
  return std::nullopt;
}

CollapsedKinds take_simpler(ElementTable& table) {
  if (!any_collapsed(table.kinds(), table.all_corners())) return {};
  ElementTable simpler;
  simpler.reserve(table.size(), table.all_corners().size());
  const CollapsedKinds collapsed = for_simpler_elements(
      table.kinds(), table.all_corners(), [&](ElementKind kind, std::span<const Index> corners) { simpler.add(kind, corners); });
  table = std::move(simpler);
  return collapsed;
}

/// Calls each(from, to, count) for the pairs of kinds that occur.
template <class Each>
void for_pairs(const CollapsedKinds& collapsed, const Each& each) {
  for (std::size_t from = 0; from < kElementKindCount; ++from)
    for (std::size_t to = 0; to < kElementKindCount; ++to)
      if (const auto count = collapsed.count(static_cast<ElementKind>(from), static_cast<ElementKind>(to)); count > 0)
        each(kElementKinds[from], kElementKinds[to], count);
}

}  // namespace

std::optional<SimplerElement> simpler_element(ElementKind kind, const CornerPattern& pattern) {
  Polygon corners;
  for (std::size_t i = 0; i < info(kind).corners; ++i)
    if (pattern[i] == i) corners.push_back(static_cast<std::uint16_t>(i));
  if (corners.size() == info(kind).corners) return std::nullopt;
  const auto simpler = kind_with(info(kind).dimension, corners.size());
  const auto left = faces_left(kind, pattern);
  if (!simpler || !left) return std::nullopt;
  do {  // tries every order, the original one first
    if (faces_left(*simpler, corners) != left) continue;
    SimplerElement found{*simpler, {}};
    std::ranges::copy(corners, found.corners.begin());
    return found;
  } while (std::next_permutation(corners.begin(), corners.end()));
  return std::nullopt;
}

bool CollapsedKinds::any() const {
  return std::ranges::any_of(counts_, [](const auto& row) { return std::ranges::any_of(row, [](std::uint64_t n) { return n > 0; }); });
}

std::vector<std::string> CollapsedKinds::sentences() const {
  std::vector<std::string> all;
  for_pairs(*this, [&](const ElementKindInfo& from, const ElementKindInfo& to, std::uint64_t count) {
    const bool one = count == 1;
    all.push_back(fmt::format("{} that {} corners twice {} taken as the {} that {}", counted(count, from.name, from.plural),
                              one ? "has" : "have", one ? "is" : "are", one ? to.name : to.plural, one ? "it is" : "they are"));
  });
  return all;
}

std::vector<std::string> CollapsedKinds::repeated() const {
  std::vector<std::string> all;
  for_pairs(*this, [&](const ElementKindInfo& from, const ElementKindInfo& to, std::uint64_t count) {
    all.push_back(fmt::format("the repeated corners of {} (written as {})", counted(count, from.name, from.plural),
                              count == 1 ? to.name : to.plural));
  });
  return all;
}

CollapsedKinds take_simpler_kinds(Mesh& mesh) {
  for (Group& group : mesh.groups) take_simpler(group.faces);
  return take_simpler(mesh.elements);
}

}  // namespace dmoscope
