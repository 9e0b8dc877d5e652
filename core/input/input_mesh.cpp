#include "core/input/input_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/input/volume_input.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/edges.h"
#include "core/mesh/orientation.h"
#include "core/mesh/seam.h"
#include "core/mesh/volume.h"

namespace dmoscope {
namespace {

constexpr Index kElementsBetweenLooks = 1U << 16U;  // elements between two looks for a cancel

bool is_planar(const Mesh& mesh, Index e) { return info(mesh.elements.kind(e)).dimension == 2; }

/// A corner twice, or no corner whose two edges span more area than rounding makes of a straight line.
bool degenerate(const Mesh& mesh, const Plane& plane, Index e) {
  constexpr double kRounding = 1e-15;
  const auto c = mesh.elements.corners(e);
  const std::size_t n = c.size();
  const auto way = [&](std::size_t from, std::size_t to) { return plane.difference(mesh.positions[c[to]], mesh.positions[c[from]]); };
  double extent = 0.0;  // edges are divided by it: nothing over- or underflows, whatever the mesh's units
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

/// Is an element of a planar mesh neither degenerate nor inverted, by so much more than rounding that nobody needs to look closer?
bool clearly_positive(const Mesh& mesh, const Plane& plane, Index e) {
  constexpr double kClear = 1e-9;
  constexpr double kSmallest = 1e-280;  // below, products lose digits
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

MeshReport examine(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const EdgeSurvey& edges, Progress& progress) {
  MeshReport report;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (topology.star(v).empty()) report.unused_vertices.push_back(v);
  }
  report.duplicate_elements = edges.duplicates;
  const QualityContext context{mesh, geometry};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    if (e % kElementsBetweenLooks == 0) {
      progress.check();
      progress.set(static_cast<double>(e) / mesh.elements.size());
    }
    if (!is_planar(mesh, e) || (geometry.shape == Shape::Planar && clearly_positive(mesh, geometry.plane, e))) continue;
    if (degenerate(mesh, geometry.plane, e)) {
      report.degenerate_elements.push_back(e);
    } else if (!(smallest_jacobian(context, mesh.positions, e) > 0.0)) {
      report.inverted_elements.push_back(e);
    }
  }
  report.non_manifold_edges = static_cast<Index>(edges.non_manifold.size());
  report.boundary_loops = count_boundary_loops(mesh, topology, edges);
  report.components = edges.components;
  report.seam_elements = count_seam_elements(mesh, geometry.plane);
  report.seam = meridian_of_seam(geometry.plane);
  report.flipped_elements = static_cast<Index>(std::ranges::count_if(mesh.flipped, [](std::uint8_t f) { return f != 0; }));
  return report;
}

void refuse_what_cannot_be_done(const Mesh& mesh, const Geometry& geometry, const std::string& file, Need need) {
  // Products of four lengths must stay finite and normal; of a volume, of eight.
  // What is smoothed may grow a little, where vertices lie outside of the boundary, and shall be read again.
  const double possible = geometry.shape == Shape::Volume ? 1e36 : 1e75;
  const double largest = need == Need::Smoothing ? 0.1 * possible : possible;
  if (mesh.elements.size() == 0) throw InputError(file, 0, "the mesh has no elements");
  if (geometry.size > largest || (geometry.size > 0.0 && geometry.size < 1.0 / possible)) {
    const std::string size = std::isfinite(geometry.size) ? fmt::format("{:.4g}", geometry.size) : std::string("more than 1e+308");
    throw InputError(
        file, 0, fmt::format("the mesh is {} units large; sizes from {:g} to {:g} can be computed with", size, 1.0 / possible, largest));
  }
  if (geometry.shape == Shape::Volume) {
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if (is_planar(mesh, e))
        throw InputError(file, 0,
                         fmt::format("the mesh mixes volume elements with {} (element {})", info(mesh.elements.kind(e)).plural, e));
  }
}

/// Area or volume, at least 0.
double measure(const Mesh& mesh, const Geometry& geometry, Index e) {
  if (geometry.shape == Shape::Volume) return std::abs(signed_volume(mesh, e));
  const Vec3 twice = area_vector(mesh, e, geometry.plane);
  return 0.5 * (geometry.shape == Shape::Planar ? std::abs(dot(twice, geometry.plane.normal)) : length(twice));
}

/// See InputMesh::reference_measure.
std::vector<double> reference_measures(const Mesh& mesh, const Geometry& geometry, const Topology& topology, Progress& progress) {
  const Index count = mesh.elements.size();
  auto reference = large_vector<double>(count);  // at first each element's own area
  double total = 0.0;
  for (Index e = 0; e < count; ++e) {
    reference[e] = measure(mesh, geometry, e);
    total += reference[e];
  }
  const double fallback = total > 0.0 ? total / count : 1.0;
  // An ideal element's corner Jacobian over its volume; in the plane areas are compared as they are.
  constexpr auto kCorner = [](ElementKind kind) {
    switch (kind) {
      case ElementKind::Tetrahedron:
        return 6.0;
      case ElementKind::Pyramid:
        return 3.0;
      case ElementKind::Wedge:
        return 2.0;
      default:
        return 1.0;
    }
  };
  // First around each vertex, then over the corners of each element: linear whatever the valence.
  auto around = large_vector<double>(mesh.positions.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (v % kElementsBetweenLooks == 0) progress.check();
    const auto star = topology.star(v);
    for (const Incidence& incidence : star) around[v] += reference[incidence.element];
    if (!star.empty()) around[v] /= static_cast<double>(star.size());
  }
  for (Index e = 0; e < count; ++e) {
    const auto corners = mesh.elements.corners(e);
    double sum = 0.0;
    for (const Index v : corners) sum += around[v];
    reference[e] = kCorner(mesh.elements.kind(e)) * (sum > 0.0 ? sum / static_cast<double>(corners.size()) : fallback);
  }
  return reference;
}

/// Does a vertex lie outside the box of the others of its star? In a sound star it never does.
bool is_stray(const Mesh& mesh, const Geometry& geometry, const Topology& topology, Index vertex) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -1.0 * low;
  for (const Incidence& at : topology.star(vertex)) {
    for (const Index other : mesh.elements.corners(at.element)) {
      if (other == vertex) continue;
      const Vec3 way = geometry.plane.difference(mesh.positions[other], mesh.positions[vertex]);
      low = {std::min(low.x, way.x), std::min(low.y, way.y), std::min(low.z, way.z)};
      high = {std::max(high.x, way.x), std::max(high.y, way.y), std::max(high.z, way.z)};
    }
  }
  return low.x > 0.0 || low.y > 0.0 || low.z > 0.0 || high.x < 0.0 || high.y < 0.0 || high.z < 0.0;
}

/// See InputMesh::has_strays.
bool find_strays(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const MeshReport& report) {
  return std::ranges::any_of(report.inverted_elements, [&](Index e) {
    return std::ranges::any_of(mesh.elements.corners(e),
                               [&](Index v) { return topology.boundary()[v] == 0 && is_stray(mesh, geometry, topology, v); });
  });
}

}  // namespace

MeshReport examine(const Mesh& mesh, const Geometry& geometry) {
  EdgeSurvey edges;
  Progress unwatched;
  const Topology topology(mesh, edges, unwatched);
  return examine(mesh, geometry, topology, edges, unwatched);
}

namespace {

std::shared_ptr<const InputMesh> assemble(Mesh mesh, Geometry geometry, Topology topology, FaceNeighbours faces, MeshReport report,
                                          std::filesystem::path path, Progress& progress, std::string generator) {
  if (mesh.source) report.file_notes = mesh.source->notes();
  std::vector<double> reference = reference_measures(mesh, geometry, topology, progress);
  progress.check();
  Interfaces interfaces(mesh, topology);
  progress.check();
  const bool has_strays = find_strays(mesh, geometry, topology, report);
  return std::make_shared<const InputMesh>(InputMesh{std::move(mesh),
                                                     geometry,
                                                     std::move(topology),
                                                     std::move(faces),
                                                     std::move(report),
                                                     std::move(path),
                                                     std::move(reference),
                                                     std::move(generator),
                                                     std::move(interfaces),
                                                     {},
                                                     {},
                                                     has_strays});
}

std::shared_ptr<const InputMesh> prepare_volume(Mesh mesh, const Geometry& geometry, std::filesystem::path path, Progress& progress,
                                                std::string generator) {
  FaceNeighbours faces(mesh, &progress);
  progress.set(0.5);
  const OrientationReport orientation = normalise_orientation(mesh, faces);
  if (orientation.flipped > 0) faces = FaceNeighbours(mesh, &progress);
  Topology topology(mesh, faces);
  progress.begin("checking");
  MeshReport report = examine_volume(mesh, geometry, topology, faces, orientation.components, progress);
  return assemble(std::move(mesh), geometry, std::move(topology), std::move(faces), std::move(report), std::move(path), progress,
                  std::move(generator));
}

}  // namespace

std::shared_ptr<const InputMesh> prepare_input(Mesh mesh, std::filesystem::path path, Need need, Progress& progress,
                                               std::string generator) {
  Geometry geometry = classify(mesh);
  refuse_what_cannot_be_done(mesh, geometry, path.empty() ? (mesh.name.empty() ? "mesh" : mesh.name) : path.string(), need);
  progress.check();

  progress.begin("finding neighbours");
  if (geometry.shape == Shape::Volume) return prepare_volume(std::move(mesh), geometry, std::move(path), progress, std::move(generator));
  EdgeSurvey edges;
  Topology topology(mesh, edges, progress);
  progress.check();
  progress.set(0.5);
  find_seam(mesh, topology, edges, geometry);
  if (geometry.shape == Shape::Planar && normalise_orientation(mesh, geometry.plane, topology, edges).flipped > 0) topology.follow(mesh);
  progress.check();

  progress.begin("checking");
  MeshReport report = examine(mesh, geometry, topology, edges, progress);
  edges = {};
  FaceNeighbours faces;
  if (geometry.shape == Shape::Surface) faces = FaceNeighbours(mesh, &progress);
  return assemble(std::move(mesh), geometry, std::move(topology), std::move(faces), std::move(report), std::move(path), progress,
                  std::move(generator));
}

}  // namespace dmoscope
