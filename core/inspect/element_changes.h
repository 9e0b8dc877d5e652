#pragma once
// Qualities of the elements around a vertex before and after a visit, by the statistics' formulas.

#include <algorithm>
#include <memory>
#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/quality/defined_quality.h"
#include "core/quality/element_shape.h"

namespace dmoscope {

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
