#include "core/input/volume_input.h"

#include <algorithm>

#include "core/input/element_findings.h"
#include "core/mesh/edges.h"

namespace dmoscope {

namespace {

constexpr Index kCellsBetweenLooks = 1U << 14U;  // elements between two checks for a cancel

/// Elements with exactly the corners (as a set) of an earlier one.
std::vector<Index> duplicates(const Mesh& mesh, const Topology& topology, Progress& progress) {
  const ElementTable& elements = mesh.elements;
  std::vector<Index> found;
  for (Index e = 0; e < elements.size(); ++e) {
    if (e % kCellsBetweenLooks == 0) progress.check();
    // Looks at the corner with the smallest star: a hub of all elements must not be examined from each.
    const auto star = topology.star(std::ranges::min(elements.corners(e), {}, [&](Index v) { return topology.star(v).size(); }));
    const auto twin = [&](const Incidence& at) {
      return at.element < e && elements.kind(at.element) == elements.kind(e) && same_corners(mesh, at.element, e);
    };
    if (std::ranges::any_of(star, twin)) found.push_back(e);
  }
  return found;
}

}  // namespace

MeshReport examine_volume(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours& faces,
                          Index components, Progress& progress) {
  MeshReport report;
  report.volume = true;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (topology.star(v).empty()) report.unused_vertices.push_back(v);
  report.duplicate_elements = duplicates(mesh, topology, progress);
  find_bad_elements(mesh, geometry, report, progress);
  report.non_manifold_faces = static_cast<Index>(faces.non_manifold().size());
  report.components = components;
  report.flipped_elements = static_cast<Index>(std::ranges::count_if(mesh.flipped, [](std::uint8_t f) { return f != 0; }));
  return report;
}

}  // namespace dmoscope
