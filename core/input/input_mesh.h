#pragma once
// The mesh of a session, with all that is derived from it once. Immutable: runs, frames and views share it.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/io/reading/io_context.h"
#include "core/mesh/faces.h"
#include "core/mesh/interfaces.h"
#include "core/mesh/mesh.h"
#include "core/mesh/mesh_view.h"
#include "core/mesh/plane.h"
#include "core/mesh/report.h"
#include "core/mesh/topology.h"
#include "core/quality/quality.h"

namespace dmoscope {

class MeshShare;

struct InputMesh {
  Mesh mesh;  // mesh with consistent orientation
  Geometry geometry;
  Topology topology;
  FaceNeighbours faces;  // neighbours in a volume mesh; also for the elements of a surface mesh, each of which is a face
  MeshReport report;
  std::filesystem::path path;             // empty for a generated mesh
  std::vector<double> reference_measure;  // positive size that divides an element's Jacobian while untangling: mean over its corners of the
                                          // mean |area| or |volume| in their stars, at input; in a volume mesh the Jacobian of an ideal
                                          // element of that size
  std::string generator{};                // words that generate this mesh again, such as "coast 4000 1"; empty for others
  Interfaces interfaces{};
  std::shared_ptr<const InputMesh> surface{};  // mesh on whose surface vertices slide; null: their own. See slide_on()
  std::vector<Vec3> surface_normals{};         // by element of a surface mesh, the normal that that surface gives it; zero: unknown
  std::vector<Index> layers{};                 // vertices of boundary layers: see layer_vertices(); empty for a share
  bool has_strays = false;  // whether a vertex of an inverted element, off the boundary, is outside the box of its star's other vertices
  std::shared_ptr<const MeshShare> share{};  // share of a mesh that several processes smooth together; null: the whole mesh
  /// Number of elements of the whole mesh, on all processes.
  [[nodiscard]] std::uint64_t whole_element_count() const;
  std::shared_ptr<const DefinedJudges> judges = make_defined_judges();  // judges of defined metrics
  [[nodiscard]] QualityContext quality_context() const { return {mesh, geometry, surface_normals, judges.get()}; }
  /// Sentence on the vertices of boundary layers, which stay unless `way_out` lets them go; empty where there are none.
  [[nodiscard]] std::string layers_sentence(std::string_view way_out) const;
  [[nodiscard]] bool is_volume() const noexcept { return geometry.shape == Shape::Volume; }
  /// Whether the mesh is drawn in space: a volume or surface mesh.
  [[nodiscard]] bool in_space() const noexcept { return geometry.shape != Shape::Planar; }
  [[nodiscard]] bool is_surface() const noexcept { return geometry.shape == Shape::Surface; }
  /// The mesh in the form that kernels read. Frame: Plane for a planar mesh, Space for a volume mesh, Curved for a surface mesh.
  template <class Frame>
  [[nodiscard]] MeshView<Frame> view() const {
    MeshView<Frame> view{topology.star_offsets().data(),     topology.incidences().data(), mesh.elements.offsets().data(),
                         mesh.elements.all_corners().data(), reference_measure.data(),     {}};
    if constexpr (std::is_same_v<Frame, Plane>) view.frame = geometry.plane;
    if constexpr (std::is_same_v<Frame, Curved>)
      view.frame = {geometry.plane.normal, geometry.mostly_flat, surface_normals.empty() ? nullptr : surface_normals.data()};
    return view;
  }
  [[nodiscard]] PlanarView planar_view() const { return view<Plane>(); }
};

/// Throws UsageError if the metric is not defined for the mesh, or its target or fields are missing there; InputError if a metric field
/// holds invalid metrics.
void require_defined(Metric metric, const InputMesh& input);

enum class Need { Smoothing, QualityOnly };

/// Throws InputError for a mesh so large or so small that the range of numbers does not suffice.
void require_computable(const Geometry& geometry, const std::string& file, Need need);

/// Classifies, orients, examines and indexes a mesh. With Need::Smoothing a surface mesh is refused (InputError that names the file).
[[nodiscard]] std::shared_ptr<const InputMesh> prepare_input(Mesh mesh, std::filesystem::path path, Need need, Progress& progress,
                                                             std::string generator = {});

/// Prepares a share of a mesh; every process prepares its own. `geometry`: that of the whole mesh, which is planar or a volume mesh and
/// does not wrap.
[[nodiscard]] std::shared_ptr<const InputMesh> prepare_share(Mesh mesh, const Geometry& geometry, std::shared_ptr<const MeshShare> share,
                                                             std::filesystem::path path, Progress& progress);

/// Generates a sample for smoothing: `words` is "KIND [SIZE [SEED]]", see generate_mesh. Throws UsageError.
[[nodiscard]] std::shared_ptr<const InputMesh> generate_input(const std::string& words, Progress& progress);

/// Reads a mesh (read_mesh), names `materials` (name_materials) and prepares it (prepare_input).
[[nodiscard]] std::shared_ptr<const InputMesh> load_input(const std::filesystem::path& path, Need need, const IoContext& context,
                                                          std::span<const std::string> materials = {});

/// Copy of the mesh after name_materials() with these names. Throws UsageError.
[[nodiscard]] std::shared_ptr<const InputMesh> with_materials(const InputMesh& input, std::span<const std::string> materials);

/// Findings about the elements (inverted, duplicates, ...); called by prepare_input, exposed for tests.
[[nodiscard]] MeshReport examine(const Mesh& mesh, const Geometry& geometry);

}  // namespace dmoscope
