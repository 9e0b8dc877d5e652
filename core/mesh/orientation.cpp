#include "core/mesh/orientation.h"

#include <algorithm>
#include <vector>

#include "core/mesh/edges.h"
#include "core/mesh/winding_sets.h"

namespace dmoscope {
namespace {

double signed_area(const Mesh& mesh, const Plane& plane, Index e) { return 0.5 * dot(area_vector(mesh, e, plane), plane.normal); }

}  // namespace

std::vector<std::uint8_t> relate_windings(const Mesh& mesh, const Topology& topology, Index& contradictions) {
  WindingSets sets(mesh.elements.size());
  for_each_edge(mesh, topology, [&](Edge, std::span<const EdgeSide> sides) {
    if (sides.size() != 2) return;
    const Index a = sides[0].element;
    const Index b = sides[1].element;
    if (a == b) return;  // an element with a repeated corner
    // Relates two neighbours: those that run their edge in the same direction are wound against each other; an element and its duplicate,
    // which lie on top of each other, are not.
    const bool same_direction = sides[0].leaving == sides[1].leaving;
    if (!sets.relate(a, b, same_direction != same_corners(mesh, a, b) ? 1 : 0)) ++contradictions;
  });
  std::vector<std::uint8_t> against(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) against[e] = sets.find(e).against;
  return against;
}

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane) {
  EdgeSurvey edges;
  Progress unwatched;
  const Topology topology(mesh, edges, unwatched);
  return normalise_orientation(mesh, plane, topology, edges);
}

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane, const Topology& topology, const EdgeSurvey& edges) {
  const Index count = mesh.elements.size();
  OrientationReport report{.components = edges.components, .contradictions = static_cast<Index>(edges.non_manifold.size())};
  std::vector<std::uint8_t> against;  // whether each element is reversed; empty: none is
  if (!edges.consistent) against = relate_windings(mesh, topology, report.contradictions);
  const auto is_against = [&](Index e) { return !against.empty() && against[e] != 0; };

  std::vector<WindingVote> votes(edges.components);
  const double whole = box_measure(mesh, 2);
  for (Index e = 0; e < count; ++e) {
    if (edges.component[e] == kNoIndex) continue;
    const double area = is_against(e) ? -signed_area(mesh, plane, e) : signed_area(mesh, plane, e);
    votes[edges.component[e]].add(area, whole);
  }
  for (Index e = 0; e < count; ++e) {
    if (edges.component[e] == kNoIndex || is_against(e) == votes[edges.component[e]].reverse()) continue;
    turn_over(mesh, e);
    ++report.flipped;
  }
  if (std::ranges::none_of(mesh.flipped, [](std::uint8_t f) { return f != 0; })) mesh.flipped.clear();
  return report;
}

}  // namespace dmoscope
