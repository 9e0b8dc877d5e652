#pragma once
// Recorder of a search's reports.

#include <algorithm>
#include <memory>
#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/quality/defined_quality.h"
#include "core/quality/element_shape.h"
#include "core/search/grid_search.h"

namespace dmoscope {

/// A trace for grid_search(): records what the search reports, in mesh units. Offset: Vec2<double> or Vec3.
template <class Offset>
class Recorder {
 public:
  explicit Recorder(double scale) : scale_(scale) {}

  template <class Real>
  void begin(const Real& objective) {
    here = static_cast<double>(objective);
    best_ = at_start = here;
  }
  template <class Real, class Point>
  void start(const Candidate<Real, Point>& best) {
    started = in_mesh_units(best.offset);
    best_ = at_start = static_cast<double>(best.objective);
  }
  template <class Real, class Point>
  void level(const CandidateGrid<Real, Point>& grid) {
    TracedLevelIn<Offset>& level = levels.emplace_back();
    level.centre = in_mesh_units(grid.centre);
    level.size = in_mesh_units(grid.size);
    level.points = grid.points;
  }
  template <class Real, class Point>
  void candidate(int /*index*/, const Point& offset, const Real& objective) {
    levels.back().offsets.push_back(in_mesh_units(offset));
    levels.back().values.push_back(static_cast<double>(objective));
  }
  template <class Real, class Point>
  void found(const Candidate<Real, Point>& best) {
    if (static_cast<double>(best.objective) > best_) choose(best.offset);
    best_ = static_cast<double>(best.objective);
  }
  /// Marks the level's candidate at this offset, compared by its bits, as the one chosen.
  template <class Point>
  void choose(const Point& offset) {
    const Offset chosen = in_mesh_units(offset);
    const auto& all = levels.back().offsets;
    for (std::size_t i = 0; i < all.size() && !levels.back().best; ++i)
      if (all[i] == chosen) levels.back().best = static_cast<int>(i);
  }

  std::vector<TracedLevelIn<Offset>> levels;
  double here = 0.0;
  Offset started{};       // centre of the first grid
  double at_start = 0.0;  // objective at that centre

 private:
  template <class Real>
  [[nodiscard]] Vec2<double> in_mesh_units(Vec2<Real> offset) const {
    return {static_cast<double>(offset.x) * scale_, static_cast<double>(offset.y) * scale_};
  }
  template <class Real>
  [[nodiscard]] Vec3 in_mesh_units(Vec3Of<Real> offset) const {
    return {static_cast<double>(offset.x) * scale_, static_cast<double>(offset.y) * scale_, static_cast<double>(offset.z) * scale_};
  }

  double scale_;
  double best_ = 0.0;
};

// Qualities of the elements around a vertex before and after a visit, by the statistics' formulas.

/// Whether elements of the star are judged corner by corner. See VisitSummary::by_corners.
template <class Frame>
[[nodiscard]] bool has_corners(const MeshView<Frame>& mesh, Index vertex) {
  const auto is_cornered = [&mesh](const Incidence& at) { return mesh.corners_of(at.element).size() > 4; };
  return std::is_same_v<Frame, Space> && std::ranges::any_of(mesh.star(vertex), is_cornered);
}

/// The changes of a vertex's elements by a completed visit. Frame: Plane, Space or Curved.
template <class Frame>
[[nodiscard]] std::vector<ElementChange> element_changes(const InputMesh& input, PositionView positions, const VisitSummary& visit) {
  const MeshView<Frame> mesh = input.view<Frame>();
  std::shared_ptr<const DefinedJudge> defined;
  if (!is_built_in(visit.metric)) defined = input.quality_context().judge(visit.metric);
  const auto judge = [&](Index element, Vec3 place, double& quality, bool& inverted) {
    const auto corners = mesh.corners_of(element);
    const auto at = [&](Index v) { return v == visit.vertex ? place : positions[v]; };
    visit_shape(mesh.frame_of(element), corners, at, [&](const auto& shape) {
      const auto built_in = [&shape]<Metric M>() { return evaluate<M>(shape); };
      if (defined)
        quality =
            defined_quality_at(*defined, {input.geometry, input.surface_normals}, input.mesh.elements.kind(element), corners, element, at);
      else if constexpr (std::is_same_v<Frame, Space>)
        quality = formulas::with_volume_metric(visit.metric, built_in);
      else
        quality = formulas::with_planar_metric(visit.metric, built_in);
      inverted = least_jacobian(shape) <= 0.0;
    });
  };
  std::vector<ElementChange> changes;
  for (const Incidence& incidence : mesh.star(visit.vertex)) {
    ElementChange& change = changes.emplace_back(ElementChange{incidence.element});
    judge(incidence.element, visit.from, change.before, change.inverted_before);
    judge(incidence.element, visit.to, change.after, change.inverted_after);
  }
  return changes;
}

}  // namespace dmoscope
