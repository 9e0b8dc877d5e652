#include "core/mesh/topology.h"

#include <numeric>

#include "core/mesh/edges.h"
#include "core/mesh/faces.h"

namespace dmoscope {

Topology::Topology(const Mesh& mesh) { (void)index(mesh, nullptr); }

Topology::Topology(const Mesh& mesh, EdgeSurvey& found, Progress& progress) { found = index(mesh, &progress); }

Topology::Topology(const Mesh& mesh, const FaceNeighbours& faces) : boundary_(mesh.positions.size(), 0) {
  follow(mesh);
  for (const auto& some : {faces.boundary(), faces.non_manifold()})
    for (const ElementFace face : some)
      for (const Index v : vertices_of(mesh.elements, face))
        if (v != kNoIndex) boundary_[v] = 1;
}

void Topology::follow(const Mesh& mesh) {
  const ElementTable& elements = mesh.elements;
  // Counts stars for a counting sort, shifted by one so that the fill pass leaves the offsets in place.
  reserve_large(offsets_, mesh.positions.size() + 2);
  offsets_.assign(mesh.positions.size() + 2, 0);
  for (const Index v : elements.all_corners()) ++offsets_[v + 2];
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  reserve_large(incidences_, elements.all_corners().size());
  incidences_.resize(elements.all_corners().size());
  for (Index e = 0; e < elements.size(); ++e) {
    const auto corners = elements.corners(e);
    for (Index i = 0; i < corners.size(); ++i) incidences_[offsets_[corners[i] + 1]++] = {e, i};
  }
  offsets_.pop_back();
}

EdgeSurvey Topology::index(const Mesh& mesh, Progress* progress) {
  follow(mesh);
  EdgeSurvey found = survey_edges(mesh, *this, progress);
  edge_count_ = found.edges;
  boundary_.assign(mesh.positions.size(), 0);
  for (const auto& [edge, element] : found.boundary) boundary_[edge.low] = boundary_[edge.high] = 1;
  for (const Edge edge : found.non_manifold) boundary_[edge.low] = boundary_[edge.high] = 1;
  return found;
}

}  // namespace dmoscope
