#include "core/input/volume_input.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/edges.h"
#include "core/mesh/volume.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr Index kCellsBetweenLooks = 1U << 14U;  // elements between two looks for a cancel

/// A corner twice, or no volume but what rounding makes of a flat element.
bool degenerate(const Mesh& mesh, Index e) {
  constexpr double kRounding = 1e-15;
  const auto corners = mesh.elements.corners(e);
  double extent = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if (corners[i] == corners[j]) return true;
    const Vec3 away = mesh.positions[corners[i]] - mesh.positions[corners[0]];
    extent = std::max({extent, std::abs(away.x), std::abs(away.y), std::abs(away.z)});
  }
  return !(std::abs(signed_volume(mesh, e)) > kRounding * extent * extent * extent);
}

/// Elements with the very corners (as a set) of an earlier one.
std::vector<Index> duplicates(const Mesh& mesh, const Topology& topology, Progress& progress) {
  const ElementTable& elements = mesh.elements;
  std::vector<Index> found;
  for (Index e = 0; e < elements.size(); ++e) {
    if (e % kCellsBetweenLooks == 0) progress.check();
    // At the corner of the smallest star: a hub of all elements must not be looked at from each.
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
  const QualityContext context{mesh, geometry};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    if (e % kCellsBetweenLooks == 0) {
      progress.check();
      progress.set(static_cast<double>(e) / mesh.elements.size());
    }
    if (degenerate(mesh, e))
      report.degenerate_elements.push_back(e);
    else if (!(smallest_jacobian(context, mesh.positions, e) > 0.0))
      report.inverted_elements.push_back(e);
  }
  report.non_manifold_faces = static_cast<Index>(faces.non_manifold().size());
  report.components = components;
  report.flipped_elements = static_cast<Index>(std::ranges::count_if(mesh.flipped, [](std::uint8_t f) { return f != 0; }));
  return report;
}

}  // namespace dmoscope
