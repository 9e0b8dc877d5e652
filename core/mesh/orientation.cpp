#include "core/mesh/orientation.h"

#include <algorithm>
#include <vector>

#include "core/mesh/edges.h"
#include "core/mesh/winding_sets.h"

namespace dmoscope {

namespace {

double signed_area(const Mesh& mesh, const Plane& plane, Index e) { return 0.5 * dot(area_vector(mesh, e, plane), plane.normal); }

/// Turns the elements of each component so that most have a positive measure; returns how many were turned. `component`: by element,
/// below `components`, or kNoIndex; `against`: whether each is wound against its component, empty if none is.
template <class Measure>
Index turn_minorities(Mesh& mesh, int dimension, std::span<const Index> component, Index components, std::span<const std::uint8_t> against,
                      const Measure& measure) {
  const auto is_against = [&](Index e) { return !against.empty() && against[e] != 0; };
  std::vector<WindingVote> votes(components);
  const double whole = box_measure(mesh, dimension);
  for (Index e = 0; e < component.size(); ++e)
    if (component[e] != kNoIndex) votes[component[e]].add(is_against(e) ? -measure(e) : measure(e), whole);
  Index turned = 0;
  for (Index e = 0; e < component.size(); ++e) {
    if (component[e] == kNoIndex || is_against(e) == votes[component[e]].reverse()) continue;
    turn_over(mesh, e);
    ++turned;
  }
  if (std::ranges::none_of(mesh.flipped, [](std::uint8_t f) { return f != 0; })) mesh.flipped.clear();
  return turned;
}

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
  OrientationReport report{.components = edges.components, .contradictions = static_cast<Index>(edges.non_manifold.size())};
  std::vector<std::uint8_t> against;  // whether each element is reversed; empty: none is
  if (!edges.consistent) against = relate_windings(mesh, topology, report.contradictions);
  report.flipped =
      turn_minorities(mesh, 2, edges.component, edges.components, against, [&](Index e) { return signed_area(mesh, plane, e); });
  return report;
}

double signed_volume(const Mesh& mesh, Index element) { return signed_volume(mesh.elements, mesh.positions, element); }

double signed_volume(const ElementTable& elements, std::span<const Vec3> positions, Index element) {
  const Vec3 origin = positions[elements.corners(element)[0]];
  double six = 0.0;
  for (Index f = 0; f < faces_of(elements.kind(element)).size(); ++f) {
    const auto vertices = vertices_of(elements, {element, f});
    const auto at = [&](Index i) { return positions[vertices[i]] - origin; };
    if (vertices[3] == kNoIndex) {
      six += dot(at(0), cross(at(1), at(2)));
      continue;
    }
    const Vec3 middle = 0.25 * (at(0) + at(1) + at(2) + at(3));
    for (Index i = 0; i < 4; ++i) six += dot(middle, cross(at(i), at((i + 1) % 4)));
  }
  return six / 6.0;
}

OrientationReport normalise_orientation(Mesh& mesh, const FaceNeighbours& neighbours) {
  const ElementTable& elements = mesh.elements;
  const Index count = elements.size();
  OrientationReport report;
  WindingSets sets(count);
  for (Index e = 0; e < count; ++e) {
    const auto across = neighbours.of(e);
    for (Index f = 0; f < across.size(); ++f) {
      if (across[f] == kNoIndex || across[f] <= e) continue;
      const ElementFace other{across[f], neighbours.face_across(elements, {e, f})};
      if (!sets.relate(e, other.element, same_direction(elements, {e, f}, other) ? 1 : 0)) ++report.contradictions;
    }
  }
  report.contradictions += static_cast<Index>(neighbours.non_manifold().size());

  std::vector<std::uint8_t> against(count);
  std::vector<Index> root(count);  // stands for the component of an element
  for (Index e = 0; e < count; ++e) {
    const auto place = sets.find(e);
    root[e] = place.root;
    against[e] = place.against;
    if (place.root == e) ++report.components;
  }
  report.flipped = turn_minorities(mesh, 3, root, count, against, [&](Index e) { return signed_volume(mesh, e); });
  return report;
}

}  // namespace dmoscope
