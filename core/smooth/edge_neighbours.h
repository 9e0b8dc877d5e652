#pragma once
// Edge neighbours of a vertex: the other ends of its edges.

#include <algorithm>
#include <vector>

#include "core/mesh/mesh_view.h"
#include "core/quality/formulas.h"

namespace dmoscope {

/// Calls visit(other) for the other end of every edge of every element of the star: around a vertex that may move each neighbour comes
/// twice, since each of its edges has two elements, so that sums over them weigh all alike.
template <class Visit>
DMOSCOPE_ANYWHERE void for_edge_neighbours(const PlanarView& mesh, Index vertex, const Visit& visit) {
  for (const Incidence& at : mesh.star(vertex)) {
    const auto corners = mesh.corners_of(at.element);
    const auto visit_other = [&](std::size_t steps) {
      if (const Index other = corners[(at.corner + steps) % corners.size()]; other != vertex) visit(other);
    };
    visit_other(1);
    visit_other(corners.size() - 1);
  }
}

/// Calls visit(corner) for the other end of each edge that leaves a volume element's corner.
template <class Visit>
void for_edges_of_corner(std::size_t corners, Index corner, const Visit& visit) {
  const auto by_table = [&](const auto& table) {
    for (std::size_t i = 1; i < 4; ++i) visit(Index{table[corner][i]});
  };
  if (corners == 4)
    for (Index i = 1; i < 4; ++i) visit(corner ^ i);
  else if (corners == 8)
    by_table(formulas::HexahedronCorners::kTable);
  else if (corners == 6)
    by_table(formulas::WedgeCorners::kTable);
  else if (corner < 4)
    by_table(formulas::PyramidCorners::kTable);
  else
    for (Index i = 0; i < 4; ++i) visit(i);
}

/// Collects the edge neighbours of a volume's vertex, each once, ascending, in `out`.
inline void gather_edge_neighbours(const VolumeView& mesh, Index vertex, std::vector<Index>& out) {
  out.clear();
  for (const Incidence& at : mesh.star(vertex)) {
    const auto corners = mesh.corners_of(at.element);
    for_edges_of_corner(corners.size(), at.corner, [&](Index corner) {
      if (corners[corner] != vertex) out.push_back(corners[corner]);
    });
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

}  // namespace dmoscope
