#include "core/io/element_sides.h"

#include <algorithm>
#include <numeric>

#include "core/mesh/faces.h"

namespace dmoscope {
namespace {

using Corners = std::array<Index, 4>;  // up to 4 corners, the rest kNoIndex

Corners in_order(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

Index count_of(const Corners& corners) { return static_cast<Index>(4 - std::ranges::count(corners, kNoIndex)); }

/// Whether two faces have the same winding, from whatever corner.
bool same_winding(const Corners& a, const Corners& b) {
  const Index n = count_of(a);
  if (n == 2) return a == b;
  for (Index first = 0; first < n; ++first) {
    Index k = 0;
    while (k < n && a[k] == b[(first + k) % n]) ++k;
    if (k == n) return true;
  }
  return false;
}

std::vector<std::optional<ElementSide>> sides_of(const Mesh& mesh, const std::vector<Corners>& wanted) {
  std::vector<Corners> keys(wanted.size());
  std::ranges::transform(wanted, keys.begin(), in_order);
  std::vector<Index> order(wanted.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [&](Index i) { return keys[i]; });
  std::vector<std::optional<ElementSide>> found(wanted.size());
  std::vector<std::uint8_t> outward(wanted.size(), 0);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    for (Index s = 0; s < side_count(mesh.elements.kind(e)); ++s) {
      const Corners side = vertices_of_side(mesh.elements, {e, s});
      const Corners key = in_order(side);
      // Avoids std::ranges::equal_range, which clang 14 cannot compile.
      auto at = std::ranges::lower_bound(order, key, {}, [&](Index i) { return keys[i]; });
      for (; at != order.end() && keys[*at] == key; ++at) {
        const bool same = same_winding(wanted[*at], side);
        if (found[*at] && (outward[*at] != 0 || !same)) continue;
        found[*at] = ElementSide{e, s};
        outward[*at] = same ? 1 : 0;
      }
    }
  }
  return found;
}

}  // namespace

Index side_count(ElementKind kind) noexcept {
  return info(kind).dimension == 3 ? static_cast<Index>(faces_of(kind).size()) : info(kind).corners;
}

std::array<Index, 4> vertices_of_side(const ElementTable& elements, ElementSide side) noexcept {
  const auto corners = elements.corners(side.element);
  if (info(elements.kind(side.element)).dimension == 3) return vertices_of(elements, ElementFace{side.element, side.side});
  return {corners[side.side], corners[(side.side + 1) % corners.size()], kNoIndex, kNoIndex};
}

std::vector<std::optional<ElementSide>> sides_of_faces(const Mesh& mesh, const ElementTable& faces) {
  std::vector<Corners> wanted(faces.size(), {kNoIndex, kNoIndex, kNoIndex, kNoIndex});
  for (Index f = 0; f < faces.size(); ++f) std::ranges::copy(faces.corners(f), wanted[f].begin());
  return sides_of(mesh, wanted);
}

std::vector<std::optional<ElementSide>> sides_of_edges(const Mesh& mesh, std::span<const Index> edges) {
  std::vector<Corners> wanted(edges.size() / 2);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = {edges[2 * i], edges[2 * i + 1], kNoIndex, kNoIndex};
  return sides_of(mesh, wanted);
}

}  // namespace dmoscope
