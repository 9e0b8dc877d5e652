#include "core/input/reference_measures.h"

#include <algorithm>
#include <cmath>

#include "core/base/memory.h"
#include "core/mesh/orientation.h"

namespace dmoscope {
namespace {

constexpr Index kVerticesBetweenLooks = 1U << 16U;  // vertices between two checks for a cancel

/// Area or volume of an element, at least 0.
double measure(const Mesh& mesh, const Geometry& geometry, Index e) {
  if (geometry.shape == Shape::Volume) return std::abs(signed_volume(mesh, e));
  const Vec3 twice = area_vector(mesh, e, geometry.plane);
  return 0.5 * (geometry.shape == Shape::Planar ? std::abs(dot(twice, geometry.plane.normal)) : length(twice));
}

}  // namespace

std::vector<double> reference_measures(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const MeshShare* share,
                                       Progress& progress) {
  const Index count = mesh.elements.size();
  auto reference = large_vector<double>(count);  // at first the measure of each element itself
  double largest = 0.0;
  for (Index e = 0; e < count; ++e) {
    reference[e] = measure(mesh, geometry, e);
    largest = std::max(largest, reference[e]);
  }
  if (share != nullptr) largest = share->greatest(largest);
  const double fallback = largest > 0.0 ? largest : 1.0;  // for elements in flat surroundings
  // Ratio of an ideal element's corner Jacobian to its volume; in the plane areas are compared directly.
  constexpr auto kCorner = [](ElementKind kind) {
    return kind == ElementKind::Tetrahedron ? 6.0 : kind == ElementKind::Pyramid ? 3.0 : kind == ElementKind::Wedge ? 2.0 : 1.0;
  };
  // Averages around each vertex first, then over the corners of each element: linear for any valence.
  auto around = large_vector<double>(mesh.positions.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (v % kVerticesBetweenLooks == 0) progress.check();
    const auto star = topology.star(v);
    for (const Incidence& incidence : star) around[v] += reference[incidence.element];
    if (!star.empty()) around[v] /= static_cast<double>(star.size());
  }
  if (share != nullptr) share->agree(around);
  for (Index e = 0; e < count; ++e) {
    const auto corners = mesh.elements.corners(e);
    double sum = 0.0;
    for (const Index v : corners) sum += around[v];
    reference[e] = kCorner(mesh.elements.kind(e)) * (sum > 0.0 ? sum / static_cast<double>(corners.size()) : fallback);
  }
  return reference;
}

}  // namespace dmoscope
