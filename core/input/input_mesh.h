#pragma once
// The mesh of a session, with everything derived from it once. Immutable: runs, frames and views share it.

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
  Mesh mesh;  // orientation normalised
  Geometry geometry;
  Topology topology;
  FaceNeighbours faces;  // of a volume, and the elements of a surface, each of which is a face
  MeshReport report;
  std::filesystem::path path;             // empty for a generated mesh
  std::vector<double> reference_measure;  // > 0, divides an element's Jacobian while untangling: mean over its corners of the mean |area|
                                          // or |volume| in their stars, at input; of a volume the Jacobian of an ideal element of that size
  std::string generator{};                // "coast 4000 1": the words that make this mesh again; empty for any other
  Interfaces interfaces{};
  std::shared_ptr<const InputMesh> surface{};  // on which vertices slide instead of on the mesh's own; null: that. See slide_on()
  std::vector<Vec3> surface_normals{};  // of a curved surface, by element: which way it looks where that surface says so; zero: unknown
  std::vector<Index> layers{};          // vertices of boundary layers: see layer_vertices(); none of a share
  bool has_strays = false;  // a vertex of an inverted element, off the boundary, that lies outside the box of its star's other vertices
  std::shared_ptr<const MeshShare> share{};  // of a mesh that several processes have together; null: this is all of it
  /// Elements of the whole mesh, whichever processes have them.
  [[nodiscard]] std::uint64_t whole_element_count() const;
  std::shared_ptr<const DefinedJudges> judges = make_defined_judges();  // of metrics that are defined by formulas and targets
  [[nodiscard]] QualityContext quality_context() const { return {mesh, geometry, surface_normals, judges.get()}; }
  [[nodiscard]] bool is_volume() const noexcept { return geometry.shape == Shape::Volume; }
  /// Drawn in space: a volume or a curved surface.
  [[nodiscard]] bool in_space() const noexcept { return geometry.shape != Shape::Planar; }
  [[nodiscard]] bool is_surface() const noexcept { return geometry.shape == Shape::Surface; }
  /// The mesh as kernels read it. Frame: Plane for a planar mesh, Space for a volume mesh, Curved for a surface.
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

/// Throws UsageError where the metric is not defined for the mesh, or its target or fields are missing there; InputError where a metric
/// field has what is no metric.
void require_defined(Metric metric, const InputMesh& input);

enum class Need { Smoothing, QualityOnly };

/// Throws InputError for a mesh so large or so small that numbers do not suffice.
void require_computable(const Geometry& geometry, const std::string& file, Need need);

/// Classifies, orients, examines and indexes a mesh. With Need::Smoothing a curved surface is refused (InputError that names the file).
[[nodiscard]] std::shared_ptr<const InputMesh> prepare_input(Mesh mesh, std::filesystem::path path, Need need, Progress& progress,
                                                             std::string generator = {});

/// The same of a share of a mesh; every process prepares its own. `geometry`: of the whole mesh, planar or a volume, which does not wrap.
[[nodiscard]] std::shared_ptr<const InputMesh> prepare_share(Mesh mesh, const Geometry& geometry, std::shared_ptr<const MeshShare> share,
                                                             std::filesystem::path path, Progress& progress);

/// A sample for smoothing: `words` is "KIND [SIZE [SEED]]", see generate_mesh. Throws UsageError.
[[nodiscard]] std::shared_ptr<const InputMesh> generate_input(const std::string& words, Progress& progress);

/// read_mesh, name_materials with `materials`, then prepare_input.
[[nodiscard]] std::shared_ptr<const InputMesh> load_input(const std::filesystem::path& path, Need need, const IoContext& context,
                                                          std::span<const std::string> materials = {});

/// The mesh after name_materials() with these names. Throws UsageError.
[[nodiscard]] std::shared_ptr<const InputMesh> with_materials(const InputMesh& input, std::span<const std::string> materials);

/// The elements' findings (inverted, duplicates, ...); called by prepare_input, exposed for tests.
[[nodiscard]] MeshReport examine(const Mesh& mesh, const Geometry& geometry);

}  // namespace dmoscope
