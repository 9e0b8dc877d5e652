#pragma once
// Quality of elements, vertices and whole meshes, always in double and always by the one definition in formulas.h.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/mesh/position_view.h"
#include "core/mesh/topology.h"
#include "core/quality/metric.h"

namespace dmoscope {

class DefinedJudge;
class DefinedJudges;
class ThreadPool;

/// A mesh without its positions, as quality needs it. A view: the mesh and geometry must outlive it.
struct QualityContext {
  const Mesh& mesh;
  const Geometry& geometry;               // Planar: signed in the plane. Surface: triangles unsigned, quadrilaterals against
                                          // geometry.plane.normal if that is mostly_flat, else against their own mean normal.
  std::span<const Vec3> normals{};        // of a Surface, by element, which then are signed by them: see InputMesh::surface_normals
  const DefinedJudges* judges = nullptr;  // of metrics that are defined by formulas and targets; null: built-in ones alone
  /// The judge of a metric that is not built in. Throws as require_defined() where it is not defined for the mesh.
  [[nodiscard]] std::shared_ptr<const DefinedJudge> judge(Metric metric) const;
  /// The judge of a metric that is not built in; null where judge() throws.
  [[nodiscard]] std::shared_ptr<const DefinedJudge> find_judge(Metric metric) const;
};

/// None so far.
[[nodiscard]] std::shared_ptr<const DefinedJudges> make_defined_judges();

/// Quality of one element with the mesh's vertices at `positions`. NaN where the metric is not defined for its kind.
[[nodiscard]] double element_quality(const QualityContext& context, PositionView positions, Metric metric, Index element);

/// Smallest signed corner Jacobian of an element: twice the corner triangle's area, six times the volume of a volume element's corner
/// tetrahedron (mesh units squared, cubed); 0 where all are positive and a hexahedron or wedge is not proved to be valid inside (see
/// core/quality/validity.h). Inverted means <= 0.
[[nodiscard]] double smallest_jacobian(const QualityContext& context, PositionView positions, Index element);

/// A place at which the Jacobian determinant of an element is not positive, or not proved to be, though it is at all corners: none where
/// the element is valid, and where its corners tell that it is inverted.
[[nodiscard]] std::optional<Vec3> inverted_inside(const QualityContext& context, PositionView positions, Index element);

/// The mean of an element's corners; of a mesh that wraps as seen from the first one, in the file's range.
[[nodiscard]] Vec3 centroid(const QualityContext& context, PositionView positions, Index element);

/// Elements that are inverted, and those of them whose corners do not tell.
struct InvertedCount {
  struct Element {
    std::uint64_t number = 0;
    bool inside_alone = false;  // its corners do not tell
    Vec3 at{};                  // then where; else the mean of its corners
  };
  static constexpr std::size_t kMostNamed = 1000;
  std::uint64_t all = 0, inside_alone = 0;
  std::vector<Element> first{};  // of all the first so many
  /// Counts an element where it is inverted. `number`: what it is called.
  void add(const QualityContext& context, PositionView positions, Index element, std::uint64_t number);
};
[[nodiscard]] InvertedCount count_inverted(const QualityContext& context, PositionView positions);

/// Quality of every element, out.size() == mesh.elements.size().
void element_qualities(const QualityContext& context, std::span<const Vec3> positions, Metric metric, ThreadPool* pool,
                       std::span<double> out);

/// Minimum over the star of `vertex` (paper eq. 1). +infinity for a vertex of no element.
[[nodiscard]] double vertex_quality(const QualityContext& context, const Topology& topology, std::span<const Vec3> positions, Metric metric,
                                    Index vertex);

/// Whole-mesh statistics of one metric.
struct Statistics {
  double minimum = 0.0;
  double mean = 0.0;
  double movable_minimum = 0.0;    // over elements with at least one free corner; +infinity when there is none
  double ceiling = 0.0;            // over elements whose corners are all fixed: they cap the minimum for ever; +infinity when there is none
  Index worst_element = kNoIndex;  // lowest index among the elements at the minimum
  Index inverted = 0;              // elements whose smallest_jacobian() is <= 0, at a corner or inside, whatever the metric
};

/// The elements whose corners are all fixed, ascending. `fixed`: one entry per vertex, non-zero where it may not move.
[[nodiscard]] std::vector<Index> immovable_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, ThreadPool* pool);

/// `immovable`: see immovable_elements. The same bits for any pool (nullptr: this thread alone).
[[nodiscard]] Statistics compute_statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                            std::span<const Index> immovable, ThreadPool* pool);
/// Statistics with the immovable elements found first; `fixed`: see immovable_elements.
[[nodiscard]] Statistics compute_statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                            std::span<const std::uint8_t> fixed, ThreadPool* pool);

}  // namespace dmoscope
