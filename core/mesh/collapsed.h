#pragma once
// Collapsed elements: elements with a repeated corner, as programs write them that know one kind of element alone, such as a hexahedron
// that is a wedge, a pyramid or a tetrahedron.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// An element without its repeated corners. `corners`: its info(kind).corners corners as indices from 0 into those of the original, in the
/// order of its kind.
struct SimplerElement {
  ElementKind kind;
  std::array<std::uint8_t, 8> corners;
};

/// For each corner of an element, the first of its corners that is the same vertex: 0, 1, 2, ... if all differ.
using CornerPattern = std::array<std::uint8_t, 8>;
template <class Vertex>
[[nodiscard]] CornerPattern corner_pattern(std::span<const Vertex> corners) {
  CornerPattern pattern{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::size_t first = 0;
    while (corners[first] != corners[i]) ++first;
    pattern[i] = static_cast<std::uint8_t>(first);
  }
  return pattern;
}

/// The simpler element that has the remaining faces of a collapsed one, in the same winding. None if no corner is repeated, or if the
/// remaining faces make no kind: opposite corners of a face that coincide, a hexahedron of seven corners.
[[nodiscard]] std::optional<SimplerElement> simpler_element(ElementKind kind, const CornerPattern& pattern);

/// Counts of collapsed elements, by their kind as written and the kind that they are.
class CollapsedKinds {
 public:
  void add(ElementKind from, ElementKind to, std::uint64_t count = 1) { counts_[place(from)][place(to)] += count; }
  [[nodiscard]] std::uint64_t count(ElementKind from, ElementKind to) const { return counts_[place(from)][place(to)]; }
  [[nodiscard]] bool any() const;
  /// Sentences for a report, one for each pair of kinds: "2 quadrilaterals that have corners twice are taken as the triangles that they
  /// are".
  [[nodiscard]] std::vector<std::string> sentences() const;
  /// Phrases on what was dropped, one for each pair of kinds: "the repeated corners of 2 quadrilaterals (written as triangles)".
  [[nodiscard]] std::vector<std::string> repeated() const;

 private:
  static std::size_t place(ElementKind kind) { return static_cast<std::size_t>(kind); }
  std::array<std::array<std::uint64_t, kElementKindCount>, kElementKindCount> counts_{};
};

/// Calls take(kind, corners) for every element, collapsed ones as the simpler element. `corners`: those of all elements, one after the
/// other.
template <class Vertex, class Take>
CollapsedKinds for_simpler_elements(std::span<const ElementKind> kinds, std::span<const Vertex> corners, const Take& take) {
  CollapsedKinds collapsed;
  std::map<std::pair<ElementKind, CornerPattern>, std::optional<SimplerElement>> known;  // each of the few patterns occurs many times
  std::array<Vertex, 8> left{};
  for (const ElementKind kind : kinds) {
    const std::span<const Vertex> own = corners.first(info(kind).corners);
    corners = corners.subspan(own.size());
    const CornerPattern pattern = corner_pattern(own);
    const auto [at, added] = known.try_emplace({kind, pattern});
    if (added) at->second = simpler_element(kind, pattern);
    const std::optional<SimplerElement>& simpler = at->second;
    if (!simpler) {
      take(kind, own);
      continue;
    }
    const std::span<const Vertex> fewer(left.data(), info(simpler->kind).corners);
    for (std::size_t i = 0; i < fewer.size(); ++i) left[i] = own[simpler->corners[i]];
    collapsed.add(kind, simpler->kind);
    take(simpler->kind, fewer);
  }
  return collapsed;
}

/// Whether any element has a repeated corner.
template <class Vertex>
[[nodiscard]] bool any_collapsed(std::span<const ElementKind> kinds, std::span<const Vertex> corners) {
  for (const ElementKind kind : kinds) {
    const std::size_t count = info(kind).corners;
    for (std::size_t i = 1; i < count; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (corners[i] == corners[k]) return true;
    corners = corners.subspan(count);
  }
  return false;
}

/// Replaces the collapsed elements of the mesh, and the collapsed faces of its groups, by simpler ones. Element numbers stay.
CollapsedKinds take_simpler_kinds(Mesh& mesh);

}  // namespace dmoscope
