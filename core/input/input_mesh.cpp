#include "core/input/input_mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/input/declared_floats.h"
#include "core/input/element_findings.h"
#include "core/input/layer_vertices.h"
#include "core/input/mesh_share.h"
#include "core/input/prepare.h"
#include "core/input/reference_measures.h"
#include "core/input/volume_input.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/edges.h"
#include "core/mesh/orientation.h"
#include "core/mesh/seam.h"
#include "core/mesh/thin.h"

namespace dmoscope {
namespace {

bool is_planar(const Mesh& mesh, Index e) { return info(mesh.elements.kind(e)).dimension == 2; }

MeshReport examine(const Mesh& mesh, const Geometry& geometry, const Topology& topology, const EdgeSurvey& edges, Progress& progress) {
  MeshReport report;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (topology.star(v).empty() && on_front(mesh, v) == v) report.unused_vertices.push_back(v);
  }
  report.duplicate_elements = edges.duplicates;
  find_bad_elements(mesh, geometry, report, progress);
  report.non_manifold_edges = static_cast<Index>(edges.non_manifold.size());
  report.boundary_loops = count_boundary_loops(mesh, topology, edges);
  report.components = edges.components;
  report.seam_elements = count_seam_elements(mesh, geometry.plane);
  report.seam = meridian_of_seam(geometry.plane);
  report.flipped_elements = static_cast<Index>(std::ranges::count_if(mesh.flipped, [](std::uint8_t f) { return f != 0; }));
  return report;
}

}  // namespace

void require_computable(const Geometry& geometry, const std::string& file, Need need) {
  // Bounds sizes so that products of four lengths stay finite and normal; in a volume mesh, of eight. A mesh may grow a little when it is
  // smoothed, if vertices lie outside of the boundary, and must be readable again.
  const double possible = geometry.shape == Shape::Volume ? 1e36 : 1e75;
  const double largest = need == Need::Smoothing ? 0.1 * possible : possible;
  if (geometry.size > largest || (geometry.size > 0.0 && geometry.size < 1.0 / possible)) {
    const std::string size = std::isfinite(geometry.size) ? fmt::format("{:.4g}", geometry.size) : std::string("more than 1e+308");
    throw InputError(
        file, 0, fmt::format("the mesh is {} units large; sizes from {:g} to {:g} can be computed with", size, 1.0 / possible, largest));
  }
}

void require_defined(Metric metric, const InputMesh& input) {
  require_defined(metric, input.mesh);
  if (is_built_in(metric)) return;
  if (input.share)
    throw UsageError(fmt::format("{} needs the whole mesh: formulas and targets are of one process alone", info(metric).name));
  (void)input.quality_context().judge(metric);
}

std::string InputMesh::layers_sentence(std::string_view way_out) const {
  if (layers.empty()) return {};
  return fmt::format("{} of boundary layers stay ({} lets them go)", counted(layers.size(), "vertex", "vertices"), way_out);
}

std::uint64_t InputMesh::whole_element_count() const { return share ? share->element_count() : mesh.elements.size(); }

namespace {

void refuse_what_cannot_be_done(const Mesh& mesh, const Geometry& geometry, const std::string& file, Need need) {
  if (mesh.elements.size() == 0) throw InputError(file, 0, "the mesh has no elements");
  require_computable(geometry, file, need);
  if (geometry.shape == Shape::Volume) {
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if (is_planar(mesh, e))
        throw InputError(file, 0,
                         fmt::format("the mesh mixes volume elements with {} (element {})", info(mesh.elements.kind(e)).plural, e));
  }
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
  if (mesh.source) report.file_notes.insert(report.file_notes.end(), mesh.source->notes().begin(), mesh.source->notes().end());
  std::vector<double> reference = reference_measures(mesh, geometry, topology, nullptr, progress);
  progress.check();
  Interfaces interfaces(mesh, topology);
  progress.check();
  const bool has_strays = find_strays(mesh, geometry, topology, report, [](Index) { return true; });
  std::vector<Index> layers = layer_vertices(mesh, geometry);
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
                                                     std::move(layers),
                                                     has_strays});
}

std::shared_ptr<const InputMesh> prepare_volume(Mesh mesh, const Geometry& geometry, std::vector<std::string> notes,
                                                std::filesystem::path path, Progress& progress, std::string generator) {
  FaceNeighbours faces(mesh, &progress);
  progress.set(0.5);
  const OrientationReport orientation = normalise_orientation(mesh, faces);
  if (orientation.flipped > 0) faces = FaceNeighbours(mesh, &progress);
  Topology topology(mesh, faces);
  progress.begin("checking");
  MeshReport report = examine_volume(mesh, geometry, topology, faces, orientation.components, progress);
  report.file_notes = std::move(notes);
  return assemble(std::move(mesh), geometry, std::move(topology), std::move(faces), std::move(report), std::move(path), progress,
                  std::move(generator));
}

}  // namespace

std::shared_ptr<const InputMesh> prepare_input(Mesh mesh, std::filesystem::path path, Need need, Progress& progress,
                                               std::string generator) {
  return prepare(std::move(mesh), std::move(path), need, progress, std::move(generator), {});
}

std::shared_ptr<const InputMesh> prepare(Mesh mesh, std::filesystem::path path, Need need, Progress& progress, std::string generator,
                                         std::vector<std::string> notes) {
  const std::string file = path.empty() ? (mesh.name.empty() ? "mesh" : mesh.name) : path.string();
  if (std::string note = round_to_declared(mesh, file); !note.empty()) notes.push_back(std::move(note));
  Geometry geometry = classify(mesh);
  refuse_what_cannot_be_done(mesh, geometry, file, need);
  progress.check();

  progress.begin("finding neighbours");
  if (geometry.shape == Shape::Volume)
    return prepare_volume(std::move(mesh), geometry, std::move(notes), std::move(path), progress, std::move(generator));
  EdgeSurvey edges;
  Topology topology(mesh, edges, progress);
  progress.check();
  progress.set(0.5);
  find_seam(mesh, topology, edges, geometry);
  if (geometry.shape == Shape::Planar && normalise_orientation(mesh, geometry.plane, topology, edges).flipped > 0) topology.follow(mesh);
  progress.check();

  progress.begin("checking");
  MeshReport report = examine(mesh, geometry, topology, edges, progress);
  report.file_notes = std::move(notes);
  edges = {};
  FaceNeighbours faces;
  if (geometry.shape == Shape::Surface) faces = FaceNeighbours(mesh, &progress);
  return assemble(std::move(mesh), geometry, std::move(topology), std::move(faces), std::move(report), std::move(path), progress,
                  std::move(generator));
}

}  // namespace dmoscope
