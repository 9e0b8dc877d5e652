#pragma once
// Quality of a star by a metric that is defined by a formula or a target, judged as the statistics do.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/search/defined_star.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

/// Judge of stars on a mesh. Both arguments must outlive it.
template <class Frame>
[[nodiscard]] DefinedStarJudge<Frame> defined_star_judge(const InputMesh& input, const DefinedJudge& judge) {
  return {judge, {input.geometry, input.surface_normals}, input.mesh.elements.kinds(), input.view<Frame>()};
}

template <class Frame>
[[nodiscard]] StarState defined_star_state(const DefinedStarJudge<Frame>& judge, PositionView positions, Index vertex, Vec3 place) {
  thread_local std::vector<double> qualities;  // kept: a visit allocates nothing
  judge.qualities(positions, vertex, place, qualities);
  std::size_t next = 0;
  return star_state_by(judge.mesh, positions, vertex, place,
                       [&next](const Incidence& /*incidence*/, const auto& /*shape*/) { return qualities[next++]; });
}

template <class Frame>
[[nodiscard]] double defined_mean(const DefinedStarJudge<Frame>& judge, PositionView positions, Index vertex, Vec3 place, MeanKind kind) {
  PowerMean<double> mean(kind);
  for (Incidence at : judge.mesh.star(vertex)) {
    at.corner = kNoIndex;  // all corners of the element
    mean.add(judge.quality(at, positions, vertex, place));
  }
  return mean.value(static_cast<double>(judge.mesh.star(vertex).size()));
}

/// Confirmation of a place, as confirm_at() gives it for built-in metrics.
template <class Frame>
[[nodiscard]] Confirmation defined_confirm_at(const DefinedStarJudge<Frame>& judge, PositionView positions, Index vertex, Vec3 target,
                                              const Untangling& rule) {
  return confirm_from(judge.mesh, positions, vertex, target, rule, defined_star_state(judge, positions, vertex, positions[vertex]),
                      [&] { return defined_star_state(judge, positions, vertex, target); });
}

}  // namespace dmoscope
