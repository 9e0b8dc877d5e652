#include "core/mesh/topology.h"

#include <numeric>

#include "core/mesh/edges.h"

namespace dmoscope {

Topology::Topology(const Mesh& mesh) : Topology(mesh, EdgeTable(mesh)) {}

Topology::Topology(const Mesh& mesh, const EdgeTable& edges)
    : offsets_(mesh.positions.size() + 2, 0), boundary_(mesh.positions.size(), 0), edge_count_(edges.size()) {
  const ElementTable& elements = mesh.elements;
  // Counting sort, shifted by one so that the fill pass leaves the offsets in place.
  for (const Index v : elements.all_corners()) ++offsets_[v + 2];
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  incidences_.resize(elements.all_corners().size());
  for (Index e = 0; e < elements.size(); ++e) {
    const auto corners = elements.corners(e);
    for (Index i = 0; i < corners.size(); ++i) incidences_[offsets_[corners[i] + 1]++] = {e, i};
  }
  offsets_.pop_back();

  for (Index i = 0; i < edges.size(); ++i) {
    if (edges.sides(i).size() == 2) continue;
    boundary_[edges.edge(i).low] = 1;
    boundary_[edges.edge(i).high] = 1;
  }
}

}  // namespace dmoscope
