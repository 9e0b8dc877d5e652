#pragma once
// The other ends of a vertex's edges.

#include "core/mesh/planar_view.h"

namespace dmoscope {

/// Calls visit(other) for the other end of every edge of every element of the star: of a vertex that may move each neighbour comes twice,
/// since each of its edges has two elements, so that sums over them weigh all alike.
template <class Visit>
void for_edge_neighbours(const PlanarView& mesh, Index vertex, const Visit& visit) {
  for (const Incidence& at : mesh.star(vertex)) {
    const auto corners = mesh.corners_of(at.element);
    for (const std::size_t step : {std::size_t{1}, corners.size() - 1})
      if (const Index other = corners[(at.corner + step) % corners.size()]; other != vertex) visit(other);
  }
}

}  // namespace dmoscope
