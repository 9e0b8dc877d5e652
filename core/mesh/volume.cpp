#include "core/mesh/volume.h"

#include <algorithm>

#include "core/mesh/winding_sets.h"

namespace dmoscope {

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

  std::vector<WindingVote> votes(count);  // vote of each component, at its root
  std::vector<std::uint8_t> against(count);
  std::vector<Index> root(count);
  const double whole = box_measure(mesh, 3);
  for (Index e = 0; e < count; ++e) {
    const auto place = sets.find(e);
    root[e] = place.root;
    against[e] = place.against;
    if (place.root == e) ++report.components;
    const double volume = signed_volume(mesh, e);
    votes[place.root].add(place.against != 0 ? -volume : volume, whole);
  }
  for (Index e = 0; e < count; ++e) {
    if ((against[e] != 0) == votes[root[e]].reverse()) continue;
    turn_over(mesh, e);
    ++report.flipped;
  }
  if (std::ranges::none_of(mesh.flipped, [](std::uint8_t f) { return f != 0; })) mesh.flipped.clear();
  return report;
}

}  // namespace dmoscope
