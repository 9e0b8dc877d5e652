#include "core/input/element_findings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.h"
#include "core/mesh/orientation.h"
#include "core/quality/quality.h"

namespace dmoscope {
namespace {

constexpr Index kElementsBetweenLooks = 1U << 14U;  // elements between two checks for a cancel

bool has_area(const Mesh& mesh, Index e) { return info(mesh.elements.kind(e)).dimension == 2; }

/// Whether a planar element has a repeated corner, or no corner whose two edges span more area than the rounding of a straight line.
bool degenerate_face(const Mesh& mesh, const Plane& plane, Index e) {
  constexpr double kRounding = 1e-15;
  const auto c = mesh.elements.corners(e);
  const std::size_t n = c.size();
  const auto way = [&](std::size_t from, std::size_t to) { return plane.difference(mesh.positions[c[to]], mesh.positions[c[from]]); };
  double extent = 0.0;  // divides the edges, so that nothing over- or underflows in any mesh units
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (c[i] == c[j]) return true;
    }
    const Vec3 edge = way(i, (i + 1) % n);
    extent = std::max({extent, std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
  }
  if (extent == 0.0) return true;
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = (1.0 / extent) * way(i, (i + 1) % n);
    const Vec3 b = (1.0 / extent) * way(i, (i + n - 1) % n);
    largest = std::max(largest, length(cross(a, b)));
  }
  return largest <= kRounding;
}

/// Whether an element of a planar mesh is neither degenerate nor inverted by so much more than rounding that no closer look is needed.
bool clearly_positive(const Mesh& mesh, const Plane& plane, Index e) {
  constexpr double kClear = 1e-9;
  constexpr double kSmallest = 1e-280;  // area below which products lose digits
  const auto c = mesh.elements.corners(e);
  const std::size_t n = c.size();
  Vec3 before = plane.difference(mesh.positions[c[0]], mesh.positions[c[n - 1]]);
  double extent = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 edge = plane.difference(mesh.positions[c[i + 1 < n ? i + 1 : 0]], mesh.positions[c[i]]);
    extent = std::max({extent, std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
    smallest = std::min(smallest, dot(cross(before, edge), plane.normal));
    before = edge;
  }
  return extent * extent > kSmallest && smallest > kClear * extent * extent;
}

/// Whether a volume element has a repeated corner, or no volume beyond the rounding of a flat one.
bool degenerate_volume(const Mesh& mesh, Index e) {
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

bool is_degenerate(const Mesh& mesh, const Geometry& geometry, Index e) {
  return geometry.shape == Shape::Volume ? degenerate_volume(mesh, e) : degenerate_face(mesh, geometry.plane, e);
}

/// Whether a vertex lies outside the bounding box of its star's other vertices; in a sound star it never does.
bool is_stray(const Mesh& mesh, const Geometry& geometry, const Topology& topology, Index vertex) {
  PointBox box;
  for (const Incidence& at : topology.star(vertex))
    for (const Index other : mesh.elements.corners(at.element))
      if (other != vertex) box.add(geometry.plane.difference(mesh.positions[other], mesh.positions[vertex]));
  const auto& [low, high] = box;
  return low.x > 0.0 || low.y > 0.0 || low.z > 0.0 || high.x < 0.0 || high.y < 0.0 || high.z < 0.0;
}

}  // namespace

void find_bad_elements(const Mesh& mesh, const Geometry& geometry, MeshReport& report, Progress& progress) {
  const QualityContext context{mesh, geometry};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    if (e % kElementsBetweenLooks == 0) {
      progress.check();
      progress.set(static_cast<double>(e) / mesh.elements.size());
    }
    if (geometry.shape != Shape::Volume && !has_area(mesh, e)) continue;
    if (geometry.shape == Shape::Planar && clearly_positive(mesh, geometry.plane, e)) continue;
    if (is_degenerate(mesh, geometry, e)) {
      report.degenerate_elements.push_back(e);
    } else if (!(smallest_jacobian(context, mesh.positions, e) > 0.0)) {
      report.inverted_elements.push_back(e);
    }
  }
}

bool find_strays(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const MeshReport& report,
                 const std::function<bool(Index)>& asked) {
  return std::ranges::any_of(report.inverted_elements, [&](Index e) {
    return std::ranges::any_of(mesh.elements.corners(e),
                               [&](Index v) { return asked(v) && topology.boundary()[v] == 0 && is_stray(mesh, geometry, topology, v); });
  });
}

}  // namespace dmoscope
