#include "core/reference/named_edges.h"

#include <algorithm>

namespace dmoscope {

NamedEdges::NamedEdges(const Mesh& mesh, const Topology& topology) : mesh_(mesh) {
  for (Index g = 0; g < mesh.groups.size(); ++g) {
    const Group& group = mesh.groups[g];
    const std::size_t step = group.dimension == 1 ? 2 : 1;
    if (group.dimension != 1 && !is_string(group)) continue;
    for (std::size_t i = 0; i + 1 < group.members.size(); i += step) add(group.members[i], group.members[i + 1], g);
    if (group.dimension == 1) lines_.push_back(&group);
  }
  std::ranges::sort(names_);
  if (!lines_.empty()) list_.emplace(NamedKind::Lines, lines_, mesh, topology);
}

bool NamedEdges::same(Index vertex, Index one, Index other) const {
  return std::ranges::equal(of(vertex, one), of(vertex, other), {}, &Name::group, &Name::group);
}

void NamedEdges::add(Index a, Index b, Index group) { names_.push_back({std::min(a, b), std::max(a, b), group}); }

std::span<const NamedEdges::Name> NamedEdges::of(Index a, Index b) const {
  const Index low = std::min(a, b), high = std::max(a, b);
  const auto first = std::lower_bound(names_.begin(), names_.end(), Name{low, high, 0});
  const auto last = std::upper_bound(first, names_.end(), Name{low, high, kNoIndex});
  return {first, last};
}

}  // namespace dmoscope
