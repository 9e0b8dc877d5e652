#include <algorithm>
#include <cstring>
#include <utility>

#include "core/input/element_findings.h"
#include "core/input/input_mesh.h"
#include "core/input/mesh_share.h"
#include "core/input/reference_measures.h"
#include "core/mesh/edges.h"

namespace dmoscope {
namespace {

/// Topology with the whole mesh's boundary; orients the elements.
Topology planar_topology(Mesh& mesh, const Geometry& geometry, const MeshShare& share, Progress& progress) {
  EdgeSurvey unused;
  Topology topology(mesh, unused, progress);
  if (share.orient(mesh, geometry, topology, nullptr) > 0) topology.follow(mesh);
  return topology;
}
Topology volume_topology(Mesh& mesh, const Geometry& geometry, const MeshShare& share, Progress& progress) {
  const FaceNeighbours faces(mesh, &progress);
  Topology topology(mesh, faces);
  if (share.orient(mesh, geometry, topology, &faces) > 0) topology.follow(mesh);
  return topology;
}

}  // namespace

InvertedCount count_inverted(const QualityContext& context, PositionView positions, const MeshShare& share) {
  InvertedCount here;
  for (Index e = 0; e < context.mesh.elements.size(); ++e)
    if (share.counts(e)) here.add(context, positions, e, share.element_numbers()[e]);
  InvertedCount all{share.sum(here.all), share.sum(here.inside_alone)};
  auto& first = here.first;
  for (const std::string& bytes : share.all_of({reinterpret_cast<const char*>(first.data()), first.size() * sizeof(first[0])})) {
    first.resize(bytes.size() / sizeof(first[0]));
    std::memcpy(first.data(), bytes.data(), bytes.size());
    all.first.insert(all.first.end(), first.begin(), first.end());
  }
  std::ranges::sort(all.first, {}, &InvertedCount::Element::number);
  all.first.resize(std::min(all.first.size(), InvertedCount::kMostNamed));
  return all;
}

std::shared_ptr<const InputMesh> prepare_share(Mesh mesh, const Geometry& geometry, std::shared_ptr<const MeshShare> share,
                                               std::filesystem::path path, Progress& progress) {
  progress.begin("finding neighbours");
  Topology topology = geometry.shape == Shape::Volume ? volume_topology(mesh, geometry, *share, progress)
                                                      : planar_topology(mesh, geometry, *share, progress);
  // Takes the boundary from the owners of vertices: elements around others' vertices are not all here.
  std::vector<std::uint8_t> boundary(topology.boundary().begin(), topology.boundary().end());
  share->agree(boundary);
  topology.set_boundary(std::move(boundary));

  progress.begin("checking");
  MeshReport report;
  report.volume = geometry.shape == Shape::Volume;
  find_bad_elements(mesh, geometry, report, progress);
  std::vector<double> reference = reference_measures(mesh, geometry, topology, share.get(), progress);
  Interfaces interfaces(mesh, topology);
  const bool strays = share->any(find_strays(mesh, geometry, topology, report, [&](Index v) { return share->owns(v); }));
  InputMesh input{std::move(mesh), geometry, std::move(topology), {}, std::move(report), std::move(path), std::move(reference)};
  input.interfaces = std::move(interfaces);
  input.has_strays = strays;
  input.share = std::move(share);
  return std::make_shared<const InputMesh>(std::move(input));
}

}  // namespace dmoscope
